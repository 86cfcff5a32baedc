// Where a view of an object fits the object's own map.
#pragma once

#include <span>

#include "clearway/geometry/pose.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// A guess of T_W_O, and how far it may be off (standard deviation along and about each axis).
struct PoseGuess {
  Pose T_W_O;
  double sigma_m, sigma_rad;
};

// The pose that fits the points (at least one) best to the map and is not far from the guesses (at
// least one): a robust point-to-distribution registration, from coarse to fine, that sets out from
// the guess that fits best. A few points are looked at, if there are many.
Pose RegisterView(const VoxelMap& map_O, std::span<const Eigen::Vector3d> points_W,
                  std::span<const PoseGuess> guesses);

}  // namespace clearway
