// The surroundings of voxels.
#pragma once

#include <algorithm>
#include <array>

#include "clearway/map/voxel_map.h"

namespace clearway {

// The voxel and the 26 that touch it.
inline std::array<VoxelKey, 27> WithNeighbours(VoxelKey at) {
  std::array<VoxelKey, 27> keys;
  for (int i = 0; i < 27; ++i) {
    keys[i] = {at.x + i % 3 - 1, at.y + i / 3 % 3 - 1, at.z + i / 9 - 1};
  }
  return keys;
}

// Whether the voxel is in that state, or one that touches it.
inline bool AtOrBeside(const VoxelMap& map, VoxelKey at, VoxelState state) {
  return std::ranges::any_of(WithNeighbours(at),
                             [&](VoxelKey key) { return map.State(key) == state; });
}

// Whether the point's voxel is occupied, or one that touches it.
inline bool NearOccupied(const VoxelMap& map, const Eigen::Vector3d& p) {
  return map.grid().Addressable(p) && AtOrBeside(map, map.grid().KeyOf(p), VoxelState::kOccupied);
}

}  // namespace clearway
