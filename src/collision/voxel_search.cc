#include "collision/voxel_search.h"

namespace clearway {

bool KeysTouching(const VoxelGrid& grid, const Aabb& box, KeyRange& keys) {
  constexpr double kRounding = 1e-9;  // of a coordinate of 100 km, with a margin
  const double limit_m = grid.limit_m();
  const Eigen::Vector3d low = (box.min.array() - kRounding).max(-limit_m);
  const Eigen::Vector3d high = (box.max.array() + kRounding).min(limit_m);
  if (!(low.array() <= high.array()).all()) return false;
  keys = {grid.KeyOf(low), grid.KeyOf(high)};
  return true;
}

}  // namespace clearway
