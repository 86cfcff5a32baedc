#include "scene/block_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// By definition.
Moments MomentsOf(const VoxelMap& map, VoxelKey min, int size) {
  Moments moments;
  for (int z = 0; z < size; ++z) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const VoxelKey key{min.x + x, min.y + y, min.z + z};
        if (map.State(key) != VoxelState::kOccupied) continue;
        const double weight = std::max<double>(*map.Find(key), 1);
        const Eigen::Vector3d p = map.grid().CenterOf(key);
        moments.count += 1;
        moments.weight += weight;
        moments.first += weight * p;
        moments.second += weight * p * p.transpose();
      }
    }
  }
  return moments;
}

void ExpectNear(const Moments& a, const Moments& b) {
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_LT((a.first - b.first).norm(), 1e-9 * (1 + b.first.norm()));
  EXPECT_LT((a.second - b.second).norm(), 1e-9 * (1 + b.second.norm()));
}

TEST(BlockMoments, AreThoseOfOccupiedVoxels) {
  Random random(1);
  VoxelMap map(0.1);
  for (int i = 0; i < 3000; ++i) {
    map.Set({random.Integer(-20, 20), random.Integer(-20, 20), random.Integer(-20, 20)},
            static_cast<LogOdds>(random.Integer(-2000, 3500)));
  }
  BlockMoments dut(map);
  for (int round = 0; round < 2; ++round) {  // the second time they are remembered
    for (int i = 0; i < 6 * 6 * 6; ++i) {
      const BlockKey key{i % 6 - 3, i / 6 % 6 - 3, i / 36 - 3};
      const VoxelKey min = VoxelAt(key, 0);
      const Moments whole = MomentsOf(map, min, 8);
      const BlockMoments::OfBlock* found = dut.Find(key);
      ASSERT_EQ(found != nullptr, whole.count > 0);
      if (found == nullptr) continue;
      ExpectNear(found->whole, whole);
      for (int octant = 0; octant < 8; ++octant) {
        const VoxelKey corner{min.x + 4 * (octant & 1), min.y + 4 * (octant >> 1 & 1),
                              min.z + 4 * (octant >> 2)};
        ExpectNear(found->octants[octant], MomentsOf(map, corner, 4));
      }
    }
  }
}

// What log-odds can be at most, in every voxel: no sum overflows.
TEST(BlockMoments, OfTheFullestBlock) {
  constexpr LogOdds kMost = std::numeric_limits<LogOdds>::max();
  OccupancyModel model;
  model.clamp_max = kMost;
  VoxelMap map(0.1, model);
  for (int i = 0; i < kVoxelsPerBlock; ++i) map.Set(VoxelAt({2, -3, 1}, i), kMost);
  ExpectNear(BlockMoments(map).Find({2, -3, 1})->whole, MomentsOf(map, {16, -24, 8}, 8));
}

}  // namespace
}  // namespace clearway
