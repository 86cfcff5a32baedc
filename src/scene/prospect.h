// How an object goes on by itself, and by how much that may be wrong.
#pragma once

#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"
#include "scene/past_misses.h"

namespace clearway {

struct Prospect {
  Twist velocity_O;
  PositionBound bound;
};

// What the bound follows from (BoundBy).
struct Evidence {
  Twist velocity_O;
  PastMisses misses;
  bool has_motion = false;
  bool of_last_motion = false;
};
Evidence EvidenceOf(std::span<const StampedPose> track, Time since, const Twist& last_motion_O,
                    const Solid& solid, const SceneParams& params);

// Of an object of that track, whose newest pose is the last: as GoesOn has it. But where the last
// motion, in the object's own past, clearly foretold it better than what fits the track (an object
// that swings, whose poses have little noise), the last motion goes on. Poses before `since` are no
// witnesses.
Prospect ProspectOf(std::span<const StampedPose> track, Time since, const Twist& last_motion_O,
                    const Solid& solid, const SceneParams& params);

}  // namespace clearway
