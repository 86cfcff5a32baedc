// Whether objects that come back under new ids are known again.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// How often objects came back, and what became of it. A plain value.
struct Identities {
  std::size_t came_back = 0;    // under a new id
  std::size_t known_again = 0;  // of those
  std::size_t wrong = 0;        // ids of one object that are another's in truth

  Identities& operator+=(const Identities& other);
};

// Follows ids of which it is told the truth. What came back counts if there was enough to know it
// by: at least kFewestFrames frames that added points to it before it was lost and as many after,
// and not lost for longer than the scene's horizon, up to which it is predicted. One thread.
class IdentityScore {
 public:
  static constexpr int kFewestFrames = 10;

  // The frame as the scene was told it, the version after it, and whose each id told so far is.
  void Add(const Frame& frame, const SceneSnapshot& scene,
           const std::map<ObjectId, ObjectId>& true_ids);

  Identities Result() const;

 private:
  struct Visit {
    ObjectId id;
    Time first, last;
    int frames = 0;
    bool known_again = false;  // as the one before
  };
  std::map<ObjectId, std::vector<Visit>> visits_;  // by true ids
  std::set<std::pair<ObjectId, ObjectId>> wrong_;
  Duration horizon_{};
};

}  // namespace clearway
