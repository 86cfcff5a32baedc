// How an object goes on after its newest pose, and by how much that may be wrong.
#pragma once

#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The velocity (in O) with which an object of that track goes on: by params.motion its last motion,
// or what fits the track, whose newest pose is the last; none if it is at rest
// (params.rest_distance_m).
Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params);

// How far from that it may be. The object's own past tells, if it is known for long enough: how far
// it was, half a second and a second later, from where it would have been predicted (the last
// motion being that between two poses, wherever a frame's motion began). Weighed against what is
// usual: for the beginning, and for luck. Poses before `since` are no witnesses.
PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params);

// The bound as seen from a prediction that long ahead, which is taken for a pose.
PositionBound BoundAfter(const PositionBound& bound, double seconds);

}  // namespace clearway
