// The convex hull of a map's voxels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/map/voxel_map.h"

namespace clearway {

// The occupied voxels' corners that a convex hull can have: of each layer of voxels, those of its
// outline. In voxels: whole numbers, so that the hull is computed on exact ones.
std::vector<Eigen::Vector3d> HullCandidates(const VoxelMap& map);

}  // namespace clearway
