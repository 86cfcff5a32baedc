// How large a box may be whose voxels are looked at one by one.
#pragma once

#include "clearway/geometry/aabb.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// Recorded boxes and badly labelled objects may be of any size: more than 2^24 voxels, a cube of
// 25 m at 0.1 m, are too many, and what is not addressable is nowhere.
inline bool CanLookThrough(const VoxelGrid& grid, const Aabb& box) {
  constexpr double kMost = 1 << 24;
  return grid.Addressable(box.min) && grid.Addressable(box.max) &&
         (box.Size() / grid.resolution_m()).prod() <= kMost;
}

}  // namespace clearway
