// The occupied voxels of a map as points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/map/voxel_map.h"

namespace clearway {

inline std::vector<Eigen::Vector3d> OccupiedCenters(const VoxelMap& map) {
  std::vector<Eigen::Vector3d> centers;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int index) { centers.push_back(map.grid().CenterOf(VoxelAt(key, index))); });
  });
  return centers;
}

}  // namespace clearway
