// A version of the scene: the value that every query is answered from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clearway/scene/dynamic_space.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// What is known of a place, or of a robot's state there. In order of precedence: out of bounds,
// occupied, beyond the horizon, unknown, free. kUnresolved is for motions whose check ran out of
// effort; nothing but kFree may be taken for free.
enum class SpaceStatus : std::uint8_t {
  kFree = 0,
  kUnknownSpace = 1,
  kBeyondHorizon = 2,
  kOccupied = 3,
  kOutOfBounds = 4,
  kUnresolved = 5,
};
const char* ToString(SpaceStatus status);

// One immutable version of the scene. Copies share memory; any thread may read one for as long as
// it likes.
struct SceneSnapshot {
  std::uint64_t version = 0;
  Time stamp;  // of the newest frame in it
  SceneParams params;
  VoxelMap static_map_W{0.1};
  DynamicSpace dynamic_W;  // what of the static map is occupied for a while only
  std::vector<std::shared_ptr<const MovingObject>> objects;  // ascending ids

  // The version without a frame.
  static SceneSnapshot Empty(const SceneParams& params);

  // The static map without dynamic space: what was known free for long before is free.
  VoxelMap LastingMap() const;

  // By any of its ids; null if there is none.
  const MovingObject* FindObject(ObjectId id) const;

  // Of the object of that id, ascending ids.
  std::vector<const MovingObject*> PartsOf(ObjectId whole) const;

  // 32 hex digits (XXH3-128): equal scenes have equal hashes on every machine and with any
  // number of threads. Covers all but `version`.
  std::string Hash() const {
    return Hash([] { return false; });
  }
  // The same; means nothing once `cancelled`, which is asked every so often, has become true.
  std::string Hash(const std::function<bool()>& cancelled) const;
};

using ScenePtr = std::shared_ptr<const SceneSnapshot>;

// Equal in all but `version`, number by number; equal scenes have equal hashes.
bool SameContent(const SceneSnapshot& a, const SceneSnapshot& b);

}  // namespace clearway
