#include "io/octomap_nodes.h"

#include <algorithm>
#include <utility>

namespace clearway {
namespace {

constexpr int kRootBlockBits = 6;  // ForEach goes through cubes of so many blocks, one by one
constexpr std::size_t kBlocksPerLook = 1024;

// The bits of x, y and z in turn.
constexpr std::uint64_t Interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits) {
  std::uint64_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    place = place << 3 | (x >> bit & 1) | (y >> bit & 1) << 1 | (z >> bit & 1) << 2;
  }
  return place;
}

// Which voxel of a block is the i-th of the octree.
constexpr std::array<std::uint16_t, kVoxelsPerBlock> kVoxelOf = [] {
  std::array<std::uint16_t, kVoxelsPerBlock> voxel_of{};
  for (std::uint32_t i = 0; i < kVoxelsPerBlock; ++i) {
    const std::uint32_t x = i & 7, y = i >> 3 & 7, z = i >> 6;
    voxel_of[Interleaved(x, y, z, kBlockBits)] = static_cast<std::uint16_t>(i);
  }
  return voxel_of;
}();

std::uint64_t PlaceOf(BlockKey key) {
  constexpr std::int32_t kHalf = kOctomapHalfWidth / kBlockSize;
  return Interleaved(static_cast<std::uint32_t>(key.x + kHalf),
                     static_cast<std::uint32_t>(key.y + kHalf),
                     static_cast<std::uint32_t>(key.z + kHalf), OctomapNodes::kRootLevel);
}

// What is written of an observed voxel.
float ValueOf(const VoxelBlock& block, int index, OctomapFormat format) {
  if (format == OctomapFormat::kFull) return static_cast<float>(Dequantized(block.log_odds[index]));
  return block.occupied.Test(index) ? 1.0F : -1.0F;  // on either side of OctoMap's threshold, 0
}

bool IsUniform(const VoxelBlock& block, OctomapFormat format) {
  if (block.observed.Count() != kVoxelsPerBlock) return false;
  if (format == OctomapFormat::kBinary) {
    return !block.occupied.Any() || block.occupied.Count() == kVoxelsPerBlock;
  }
  return std::ranges::count(block.log_odds, block.log_odds[0]) == kVoxelsPerBlock;
}

struct PlacedBlock {
  std::uint64_t place;
  const VoxelBlock* block;
};

// All blocks by their places.
std::vector<PlacedBlock> SortedBlocks(const VoxelMap& map, const std::function<bool()>& cancelled) {
  std::vector<std::vector<PlacedBlock>> cubes;
  std::size_t looks = 0;
  const auto cube_of = [](std::uint64_t place) { return place >> 3 * kRootBlockBits; };
  const auto add = [&](BlockKey key, const VoxelBlock& block) {
    const std::uint64_t place = PlaceOf(key);
    if (cubes.empty() || cube_of(cubes.back()[0].place) != cube_of(place)) cubes.emplace_back();
    cubes.back().push_back({place, &block});
    return ++looks % kBlocksPerLook == 0 && cancelled();
  };
  if (map.blocks().AnyBlock(add)) return {};
  std::ranges::sort(cubes, {}, [](const auto& cube) { return cube[0].place; });
  std::vector<PlacedBlock> sorted;
  sorted.reserve(map.blocks().size());
  for (auto& cube : cubes) {
    if (cancelled()) break;
    std::ranges::sort(cube, {}, &PlacedBlock::place);
    sorted.insert(sorted.end(), cube.begin(), cube.end());
    cube = {};
  }
  return sorted;
}

}  // namespace

OctomapNode ParentOf(const OctomapChildren& children) {
  OctomapNode parent;
  bool alike = true;
  for (const OctomapNode& child : children) {
    alike = alike && child.exists() && child.leaf && child.log_odds == children[0].log_odds;
    if (!child.exists()) continue;
    parent.log_odds = parent.exists() ? std::max(parent.log_odds, child.log_odds) : child.log_odds;
    parent.count += child.count;
  }
  if (alike) return {1, children[0].log_odds, true};
  if (parent.exists()) ++parent.count;
  return parent;
}

OctomapBlock::OctomapBlock(const VoxelBlock& block, OctomapFormat format) {
  for (std::size_t i = 0; i < kVoxelsPerBlock; ++i) {
    const int index = kVoxelOf[i];
    if (!block.observed.Test(index)) continue;
    nodes_[kFirst[kVoxelLevel] + i] = {1, ValueOf(block, index, format), true};
  }
  for (int level = kVoxelLevel - 1; level >= 0; --level) {
    const std::size_t size = kFirst[level + 1] - kFirst[level];
    for (std::size_t i = 0; i < size; ++i) {
      nodes_[kFirst[level] + i] = ParentOf(ChildrenOf(level, i));
    }
  }
}

OctomapNode OctomapBlock::RootOf(const VoxelBlock& block, OctomapFormat format) {
  if (IsUniform(block, format)) return {1, ValueOf(block, 0, format), true};
  return OctomapBlock(block, format).nodes_[0];
}

OctomapChildren OctomapBlock::ChildrenOf(int level, std::size_t i) const {
  OctomapChildren children;
  std::copy_n(&nodes_[kFirst[level + 1] + 8 * i], children.size(), children.begin());
  return children;
}

OctomapNodes::OctomapNodes(const VoxelMap& map, OctomapFormat format,
                           const std::function<bool()>& cancelled) {
  const std::vector<PlacedBlock> sorted = SortedBlocks(map, cancelled);
  blocks_.reserve(sorted.size());
  levels_[0].reserve(sorted.size());
  for (const auto& [place, block] : sorted) {
    if (blocks_.size() % kBlocksPerLook == 0 && cancelled()) return;
    levels_[0].push_back({place, 0, OctomapBlock::RootOf(*block, format)});
    blocks_.push_back(block);
  }
  for (int level = 1; level <= kRootLevel; ++level) AddParents(level);
}

void OctomapNodes::AddParents(int level) {
  const std::vector<Entry>& below = levels_[level - 1];
  for (std::size_t i = 0; i < below.size(); ++i) {
    const std::uint64_t place = below[i].place >> 3;
    if (levels_[level].empty() || levels_[level].back().place != place) {
      levels_[level].push_back({place, i, {}});
    }
  }
  for (std::size_t i = 0; i < levels_[level].size(); ++i) {
    // OctoMap never prunes its root.
    OctomapNode parent = ParentOf(ChildrenOf(level, i));
    if (level == kRootLevel && parent.leaf) parent = {9, parent.log_odds, false};
    levels_[level][i].node = parent;
  }
}

OctomapChildren OctomapNodes::ChildrenOf(int level, std::size_t i) const {
  const std::vector<Entry>& below = levels_[level - 1];
  OctomapChildren children;
  const std::size_t first = levels_[level][i].first_child;
  for (std::size_t k = first; k < below.size() && below[k].place >> 3 == levels_[level][i].place;
       ++k) {
    children[below[k].place & 7] = below[k].node;
  }
  return children;
}

}  // namespace clearway
