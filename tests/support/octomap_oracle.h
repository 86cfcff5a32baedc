// OctoMap as the oracle of our maps.
#pragma once

#include <octomap/OcTree.h>
#include <octomap/octomap.h>

#include <cmath>
#include <span>

#include "clearway/map/voxel_map.h"

namespace clearway::testing_support {

inline octomap::Pointcloud ToOctomap(std::span<const Eigen::Vector3f> points) {
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& p : points) cloud.push_back(p.x(), p.y(), p.z());
  return cloud;
}

inline octomap::point3d ToOctomap(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

inline VoxelKey FromOctomap(const octomap::OcTreeKey& key) {
  return {key[0] - 32768, key[1] - 32768, key[2] - 32768};
}

// How two maps differ, over every voxel that either has observed.
struct MapComparison {
  std::int64_t voxels = 0;  // observed by either
  std::int64_t state_differences = 0;
  double largest_log_odds_error = 0;  // over voxels observed by both
};

inline MapComparison Compare(const VoxelMap& dut, octomap::OcTree& oracle) {
  MapComparison result;
  oracle.expand();
  std::int64_t in_both = 0;
  for (auto leaf = oracle.begin_leafs(); leaf != oracle.end_leafs(); ++leaf) {
    ++result.voxels;
    const VoxelKey key = FromOctomap(leaf.getKey());
    const std::optional<LogOdds> value = dut.Find(key);
    if (!value) {
      ++result.state_differences;
      continue;
    }
    ++in_both;
    result.state_differences +=
        (dut.State(key) == VoxelState::kOccupied) != oracle.isNodeOccupied(*leaf);
    result.largest_log_odds_error =
        std::max(result.largest_log_odds_error,
                 std::abs(Dequantized(*value) - static_cast<double>(leaf->getLogOdds())));
  }
  const std::int64_t only_ours = dut.observed_count() - in_both;
  result.voxels += only_ours;
  result.state_differences += only_ours;
  return result;
}

}  // namespace clearway::testing_support
