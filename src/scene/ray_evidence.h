// What the rays of a frame say of an object where somebody says it is.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// Whether the object cannot be at T_W_O: most rays that meet its occupied voxels there go on
// through them, or end there on another object. False if only a few rays meet them, for its points
// of this frame.
bool IsPassedThrough(const MovingObject& object, const Pose& T_W_O,
                     std::span<const std::uint32_t> points, const LabelledCloud& cloud,
                     const SceneParams& params);

// Whether the object's map, with O at T_W_O, is a smear of views at wrong poses. Its points of this
// frame, at least one, go on beyond its box (`growth_O`: whereto) by a tenth of their length or
// more. What the box holds behind them is at least as long as they are, and not there: rays go on
// through it, or end on the object's own points before it. Of an object that is longer than a view
// of it, such rays would end on it, or on what hides it.
bool IsSmeared(const MovingObject& object, const Pose& T_W_O, const Eigen::Vector3d& growth_O,
               std::span<const std::uint32_t> points, const LabelledCloud& cloud,
               const SceneParams& params);

}  // namespace clearway
