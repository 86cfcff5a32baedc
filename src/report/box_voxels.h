// The voxels of a box, looked at one by one.
#pragma once

#include <cmath>
#include <cstdint>

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

// Calls visit(VoxelKey first, std::int32_t count) for rows along x of the voxels whose centre lies
// in a box in B. None if there are too many of them.
template <class Visit>
void ForEachRowIn(const VoxelGrid& grid, const Aabb& box_B, const Pose& T_W_B, Visit&& visit) {
  if (box_B.Empty()) return;
  const Aabb box_W = Transformed(T_W_B, box_B);
  if (!CanLookThrough(grid, box_W)) return;
  const Pose T_B_W = Inverse(T_W_B);
  const VoxelKey min = grid.KeyOf(box_W.min), max = grid.KeyOf(box_W.max);
  const Eigen::Vector3d voxel_B = T_B_W.rotation * Eigen::Vector3d(grid.resolution_m(), 0, 0);
  for (VoxelKey row = min; row.z <= max.z; ++row.z) {
    for (row.y = min.y; row.y <= max.y; ++row.y) {
      const LinePart part =
          Clip(box_B, T_B_W * grid.CenterOf(row), voxel_B, {0, static_cast<double>(max.x - min.x)});
      if (part.begin > part.end) continue;
      const auto begin = static_cast<std::int32_t>(std::ceil(part.begin));
      const auto end = static_cast<std::int32_t>(std::floor(part.end)) + 1;
      if (begin < end) visit(VoxelKey{min.x + begin, row.y, row.z}, end - begin);
    }
  }
}

}  // namespace clearway
