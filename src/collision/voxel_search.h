// Which voxels of a map may matter to a shape: the broad phase.
#pragma once

#include <algorithm>
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
