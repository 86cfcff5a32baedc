// Where something moves that nobody has told of.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// A voxel of the static map that was known free for long and is hit now and again since
// `first_hit`.
struct DynamicVoxel {
  VoxelKey key;
  Time first_hit, last_hit;
  bool operator==(const DynamicVoxel&) const = default;
};

// The order of dynamic voxels: by blocks, then by their place in the block.
inline bool ComesBefore(VoxelKey a, VoxelKey b) {
  const BlockKey block_a = BlockOf(a), block_b = BlockOf(b);
  return block_a == block_b ? IndexInBlock(a) < IndexInBlock(b) : block_a < block_b;
}

// The voxels of a static map that are occupied for a while only (SceneParams::dynamic_life). A
// value: copies share memory, and any thread may read one.
class DynamicSpace {
 public:
  DynamicSpace() = default;
  // In ascending order, each once.
  explicit DynamicSpace(std::vector<DynamicVoxel> voxels);

  std::span<const DynamicVoxel> voxels() const;
  // Null if the voxel is not dynamic space.
  const DynamicVoxel* Find(VoxelKey key) const;

  bool operator==(const DynamicSpace& other) const;

 private:
  std::shared_ptr<const std::vector<DynamicVoxel>> voxels_;  // null: none
};

}  // namespace clearway
