// Where an object is by its points alone.
#pragma once

#include <optional>
#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// Whether params.motion_from_points applies to points of the object that come at `stamp` without a
// motion or pose: kAuto does if frames never gave one, or none for longer than sources with
// keyframes pause. What is stated of it counts first.
bool MayBeEstimated(const MovingObject& object, Time stamp, const SceneParams& params);

// What the motion of the next view is estimated from. At least one point.
LastView ViewOf(std::span<const Eigen::Vector3d> points_W, const Pose& T_O_W, Time stamp,
                const SceneParams& params);

// T_W_O at `stamp`, after the object's newest pose, of the view that fits the object's map: near
// where it is predicted, and where the points moved since they were seen last. W's z points up:
// objects turn about it and hardly tilt.
Pose PoseFromPoints(const MovingObject& object, std::span<const Eigen::Vector3d> points_W,
                    Time stamp, const SceneParams& params);

}  // namespace clearway
