// Where a view of an object fits the object's own map.
#pragma once

#include <span>

#include "clearway/map/voxel_map.h"
#include "scene/registration.h"

namespace clearway {

// The T_W_O that fits the points best to the map and is not far from the guesses (at least one);
// without points, between the guesses. A few points are looked at, if there are many.
Pose RegisterView(const VoxelMap& map_O, std::span<const Eigen::Vector3d> points_W,
                  std::span<const PoseGuess> guesses);

}  // namespace clearway
