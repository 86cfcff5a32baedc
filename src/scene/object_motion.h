// How an object goes on after its newest pose.
#pragma once

#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The middle of the object, in O.
Eigen::Vector3d CenterOf(const Solid& solid);

// The velocity (in O) with which an object of that track goes on: by params.motion its last motion,
// or what fits the track, whose newest pose is the last; none if it is at rest
// (params.rest_distance_m).
Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params);

// The same, of a track of two poses or more whose last motion is that between the last two.
Twist GoesOnByItself(std::span<const StampedPose> track, const Solid& solid,
                     const SceneParams& params);

// The velocity between the last two poses, in O.
Twist LastMotionOf(std::span<const StampedPose> track);

}  // namespace clearway
