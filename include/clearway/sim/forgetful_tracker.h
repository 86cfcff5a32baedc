// What a tracker makes of objects that go out of its sight.
#pragma once

#include <map>
#include <optional>

#include "clearway/base/time.h"
#include "clearway/scene/frame.h"

namespace clearway {

// Gives an object that it has not seen for longer than `memory` a new id once it sees it again, and
// says nothing of what it does not see. One thread.
class ForgetfulTracker {
 public:
  explicit ForgetfulTracker(Duration memory) : memory_(memory) {}

  // The frame as the tracker would tell it; frames in the order of their stamps, ids below
  // kFirstNewId. An object keeps its own id when it is first seen; later ones count from
  // kFirstNewId. Motions are of what it saw before and has not lost, since it last saw it.
  Frame Retold(Frame frame);

  // By every id that was told, whose it is.
  const std::map<ObjectId, ObjectId>& true_ids() const { return true_ids_; }

  static constexpr ObjectId kFirstNewId = 1'000'000;

 private:
  struct Track {
    ObjectId told = 0;
    Time last_seen;
    std::optional<Pose> H_W;  // since then, if it moved in this frame
  };
  // What the frame tells of the object, of its true id, that it shows.
  ObjectId See(ObjectId id, Frame& told);

  Duration memory_;
  std::map<ObjectId, Track> tracks_;  // by true ids
  std::map<ObjectId, ObjectId> true_ids_;
  ObjectId next_ = kFirstNewId;
};

}  // namespace clearway
