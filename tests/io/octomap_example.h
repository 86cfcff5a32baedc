// Maps for the tests of OctoMap files, and OctoMap to compare with.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <memory>
#include <random>
#include <sstream>
#include <string>

#include "clearway/io/octomap_file.h"

namespace clearway {

inline constexpr std::int32_t kHalfWidth = 1 << 15;

// Voxels of every value in random places, on both sides of the origin, and a solid cube that
// OctoMap prunes.
inline VoxelMap ExampleMap() {
  VoxelMap map(0.1);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(-40, 40), value(-8192, 14381);
  for (int i = 0; i < 3000; ++i) {
    map.Set({place(random), place(random), place(random)}, static_cast<LogOdds>(value(random)));
  }
  for (int i = 0; i < 32 * 32 * 32; ++i) {
    map.Set({64 + i % 32, i / 32 % 32, i / 1024}, map.model().clamp_max);
  }
  return map;
}

inline std::unique_ptr<octomap::OcTree> ReadByOctomap(const std::string& bytes,
                                                      OctomapFormat format) {
  std::istringstream in(bytes);
  if (format == OctomapFormat::kBinary) {
    auto tree = std::make_unique<octomap::OcTree>(1.0);
    return tree->readBinary(in) ? std::move(tree) : nullptr;
  }
  return std::unique_ptr<octomap::OcTree>(
      dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(in)));
}

inline octomap::OcTreeKey KeyFor(VoxelKey key) {
  return {static_cast<octomap::key_type>(key.x + kHalfWidth),
          static_cast<octomap::key_type>(key.y + kHalfWidth),
          static_cast<octomap::key_type>(key.z + kHalfWidth)};
}

// Calls visit(key, log_odds) for each voxel of the tree, pruned ones expanded.
template <class Tree, class Visit>
inline void ForEachVoxel(const Tree& tree, Visit&& visit) {
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey first = leaf.getIndexKey();
    const std::int32_t width = 1 << (16 - leaf.getDepth());
    for (std::int32_t i = 0; i < width * width * width; ++i) {
      visit(VoxelKey{first[0] - kHalfWidth + i % width, first[1] - kHalfWidth + i / width % width,
                     first[2] - kHalfWidth + i / width / width},
            leaf->getLogOdds());
    }
  }
}

inline std::int64_t StateDifferences(const VoxelMap& map, const octomap::OcTree& tree) {
  std::int64_t differences = 0, voxels = 0;
  ForEachVoxel(tree, [&](VoxelKey key, float log_odds) {
    ++voxels;
    const VoxelState state = log_odds >= 0 ? VoxelState::kOccupied : VoxelState::kFree;
    differences += map.State(key) != state;
  });
  return differences + std::abs(voxels - map.observed_count());
}

inline std::string Serialized(const VoxelMap& map, OctomapFormat format) {
  const auto bytes = SerializeOctomap(map, format);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  return bytes.value_or("");
}

inline std::string ErrorOf(const std::string& bytes) {
  const auto file = ParseOctomap("m.bt", bytes);
  EXPECT_EQ(file.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(file.status().message());
}

inline const std::string kHeader =
    "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n";

}  // namespace clearway
