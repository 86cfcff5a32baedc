// Which voxels of a map may matter to a shape: the broad phase.
#pragma once

#include <algorithm>
#include <bit>
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

// The voxels of one block that lie in the range.
BlockMask MaskOfRange(BlockKey block, const KeyRange& keys);

// What of a block is searched for. A null block has never been observed.
struct OccupiedVoxels {
  static constexpr bool kInMissingBlocks = false;
  static BlockMask Of(const VoxelBlock* block) { return block->occupied; }
};
struct UnobservedVoxels {
  static constexpr bool kInMissingBlocks = true;
  static BlockMask Of(const VoxelBlock* block) {
    BlockMask all;
    all.words.fill(~std::uint64_t{0});
    return block == nullptr ? all : all.Subtract(block->observed);
  }
};

// Calls visit(BlockKey, const VoxelBlock*) for the blocks in the range; with `kMissing` for those
// that do not exist too. Stops when visit returns true; returns whether it did.
template <bool kMissing, class Visit>
bool AnyBlock(const BlockTree& blocks, BlockKey min, BlockKey max, Visit&& visit) {
  bool found = false;
  if constexpr (kMissing) {
    for (BlockKey key{0, 0, min.z}; key.z <= max.z; ++key.z) {
      for (key.y = min.y; key.y <= max.y; ++key.y) {
        for (key.x = min.x; key.x <= max.x; ++key.x) {
          if (visit(key, blocks.Find(key))) return true;
        }
      }
    }
  } else {
    blocks.ForEachIn(min, max, [&](BlockKey key, const VoxelBlock& block) {
      found = found || visit(key, &block);
    });
  }
  return found;
}

// Whether visit(VoxelKey) is true for any voxel of the kind in the range; stops at the first.
template <class Kind, class Visit>
bool AnyVoxel(const VoxelMap& map, const KeyRange& keys, Visit&& visit) {
  return AnyBlock<Kind::kInMissingBlocks>(
      map.blocks(), BlockOf(keys.min), BlockOf(keys.max),
      [&](BlockKey block_key, const VoxelBlock* block) {
        const BlockMask kind = Kind::Of(block), in_range = MaskOfRange(block_key, keys);
        for (int z = 0; z < kBlockSize; ++z) {
          for (std::uint64_t word = kind.words[z] & in_range.words[z]; word != 0;
               word &= word - 1) {
            if (visit(VoxelAt(block_key, z * 64 + std::countr_zero(word)))) return true;
          }
        }
        return false;
      });
}

}  // namespace clearway
