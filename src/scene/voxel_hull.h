// The convex hull of a map's voxels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/map/voxel_map.h"

namespace clearway {

// The occupied voxels' corners that a convex hull can have: of each z, those of its outline, and of
// these likewise of each x. In voxels: whole numbers, so that the hull is computed on exact ones.
std::vector<Eigen::Vector3d> HullCandidates(const VoxelMap& map);

// Keeps, of the points of each z, the corners of their outline: no others are corners of a convex
// hull. They are sorted by z.
void KeepOutlines(std::vector<Eigen::Vector3d>& points);

}  // namespace clearway
