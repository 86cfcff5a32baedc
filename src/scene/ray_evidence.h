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

}  // namespace clearway
