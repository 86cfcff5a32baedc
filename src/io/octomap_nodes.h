// The nodes of OctoMap's octree, computed from a map's blocks without building the tree.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "clearway/io/octomap_file.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

inline constexpr std::int32_t kOctomapHalfWidth = 1 << 15;  // its tree_max_val

// A cube of the octree. A value.
struct OctomapNode {
  std::uint64_t count = 0;  // it and the nodes below it; 0: there is none
  float log_odds = 0;       // a leaf's own, else the greatest of its children, as searches expect
  bool leaf = false;        // a voxel, or pruned

  bool exists() const { return count > 0; }
};

// Child i lies at the upper half of the cube along x, y and z where bits 0, 1 and 2 of i are set.
using OctomapChildren = std::array<OctomapNode, 8>;

// Their parent, pruned if they are all leaves of one value.
OctomapNode ParentOf(const OctomapChildren& children);

// The nodes within one block, whose own is the root.
class OctomapBlock {
 public:
  // .bt keeps states alone: all that is occupied gets one value, and all that is free another.
  OctomapBlock(const VoxelBlock& block, OctomapFormat format);
  // The root alone, which takes less where the block is all of one value.
  static OctomapNode RootOf(const VoxelBlock& block, OctomapFormat format);

  static constexpr int kVoxelLevel = kBlockBits;  // the root's is 0
  // Of node i of a level above the voxels'; they are 8 i to 8 i + 7 of the level below.
  OctomapChildren ChildrenOf(int level, std::size_t i) const;

 private:
  static constexpr std::array<std::size_t, kVoxelLevel + 1> kFirst = {0, 1, 1 + 8, 1 + 8 + 64};
  std::array<OctomapNode, kFirst[kVoxelLevel] + kVoxelsPerBlock> nodes_;  // level by level
};

// The nodes of a whole map, above and at its blocks.
class OctomapNodes {
 public:
  // The blocks of the map must stay where they are, and lie within OctoMap's bounds. Takes some 60
  // bytes a block. Incomplete once `cancelled`, which is asked every so often, has become true.
  OctomapNodes(const VoxelMap& map, OctomapFormat format, const std::function<bool()>& cancelled);

  static constexpr int kRootLevel = 16 - kBlockBits;  // the blocks' is 0
  bool Empty() const { return levels_[kRootLevel].empty(); }
  const OctomapNode& root() const { return levels_[kRootLevel][0].node; }

  // The children of node i of a level above the blocks', and which of the level below is the first.
  OctomapChildren ChildrenOf(int level, std::size_t i) const;
  std::size_t FirstChildOf(int level, std::size_t i) const { return levels_[level][i].first_child; }
  const VoxelBlock& block(std::size_t i) const { return *blocks_[i]; }

 private:
  struct Entry {
    std::uint64_t place;  // three bits for each level from the root on: which child it is
    std::size_t first_child;
    OctomapNode node;
  };
  void AddParents(int level);

  std::vector<const VoxelBlock*> blocks_;
  std::array<std::vector<Entry>, kRootLevel + 1> levels_;
};

}  // namespace clearway
