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

BlockMask MaskOfRange(BlockKey block, const KeyRange& keys) {
  const VoxelKey base = VoxelAt(block, 0);
  const auto first = [](std::int32_t key, std::int32_t from) { return std::max(key - from, 0); };
  const auto last = [](std::int32_t key, std::int32_t from) {
    return std::min(key - from, kBlockSize - 1);
  };
  // Eight bits for the row along x, eight bytes for its copies along y.
  const std::uint64_t row =
      (0xffu >> (7 - last(keys.max.x, base.x))) & (0xffu << first(keys.min.x, base.x));
  constexpr std::uint64_t kAll = ~std::uint64_t{0};
  const std::uint64_t plane = row * 0x0101'0101'0101'0101 &
                              kAll >> 8 * (7 - last(keys.max.y, base.y)) &
                              kAll << 8 * first(keys.min.y, base.y);
  BlockMask mask;
  for (int z = first(keys.min.z, base.z); z <= last(keys.max.z, base.z); ++z) {
    mask.words[z] = plane;
  }
  return mask;
}

}  // namespace clearway
