// Which voxels of a map may matter to a shape: the broad phase.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// Whether nobody waits for the answer any more: long searches ask now and then, and give up.
using Cancelled = std::function<bool()>;

// Voxels by the ends of a range of keys, both included.
struct KeyRange {
  VoxelKey min, max;
};

// The addressable voxels that touch the box, and those whose common face with it is hidden by
// rounding. `box` must not be empty; false if no voxel does.
bool KeysTouching(const VoxelGrid& grid, const Aabb& box, KeyRange& keys);

inline bool InOneOf(const std::vector<Aabb>& boxes, const Eigen::Vector3d& p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return box.Contains(p); });
}

// The voxels of one block that lie in a range: the same ones in layers first_z to last_z.
class RangeInBlock {
 public:
  RangeInBlock(BlockKey block, const KeyRange& keys) {
    const VoxelKey base = VoxelAt(block, 0);
    const auto first = [](std::int32_t key, std::int32_t from) { return std::max(key - from, 0); };
    const auto last = [](std::int32_t key, std::int32_t from) {
      return std::min(key - from, kBlockSize - 1);
    };
    // Eight bits for the row along x, eight bytes for its copies along y.
    const std::uint64_t row =
        (0xffu >> (7 - last(keys.max.x, base.x))) & (0xffu << first(keys.min.x, base.x));
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    layer_ = row * 0x0101'0101'0101'0101 & kAll >> 8 * (7 - last(keys.max.y, base.y)) &
             kAll << 8 * first(keys.min.y, base.y);
    first_z_ = first(keys.min.z, base.z);
    last_z_ = last(keys.max.z, base.z);
  }

  // Word by word, as what is stored so is read back without a wait.
  BlockMask Of(const BlockMask& mask) const {
    BlockMask in_range;
    for (int z = 0; z < kBlockSize; ++z) in_range.words[z] = Layer(z) & mask.words[z];
    return in_range;
  }
  BlockMask All() const {
    BlockMask in_range;
    for (int z = 0; z < kBlockSize; ++z) in_range.words[z] = Layer(z);
    return in_range;
  }

 private:
  std::uint64_t Layer(int z) const { return z >= first_z_ && z <= last_z_ ? layer_ : 0; }

  std::uint64_t layer_;
  int first_z_, last_z_;
};

// The voxels of a block that were never observed. A null block has never been.
inline BlockMask UnobservedIn(const VoxelBlock* block) {
  BlockMask all;
  all.words.fill(~std::uint64_t{0});
  return block == nullptr ? all : all.Subtract(block->observed);
}

// Calls visit(BlockKey, const VoxelBlock*) for the blocks in the range, those that do not exist
// too. Stops when visit returns true; returns whether it did.
template <class Visit>
bool AnyBlock(const BlockTree& blocks, BlockKey min, BlockKey max, Visit&& visit) {
  for (BlockKey key{0, 0, min.z}; key.z <= max.z; ++key.z) {
    for (key.y = min.y; key.y <= max.y; ++key.y) {
      for (key.x = min.x; key.x <= max.x; ++key.x) {
        if (visit(key, blocks.Find(key))) return true;
      }
    }
  }
  return false;
}

}  // namespace clearway
