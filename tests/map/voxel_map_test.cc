#include "clearway/map/voxel_map.h"

#include <gtest/gtest.h>

#include <map>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

VoxelKey RandomKey(Random& random) {
  const int x = random.Integer(-20, 20), y = random.Integer(-20, 20);
  return {x, y, random.Integer(-20, 20)};
}

TEST(VoxelMap, Empty) {
  const VoxelMap dut(0.1);
  EXPECT_EQ(dut.State({0, 0, 0}), VoxelState::kUnknown);
  EXPECT_EQ(dut.Find({0, 0, 0}), std::nullopt);
  EXPECT_EQ(dut.observed_count(), 0);
  EXPECT_TRUE(dut.ObservedBox().Empty());
}

TEST(VoxelMap, ZeroLogOddsIsObserved) {
  VoxelMap dut(0.1);
  dut.Set({1, 2, 3}, 0);
  EXPECT_EQ(dut.State({1, 2, 3}), VoxelState::kOccupied);
  EXPECT_EQ(dut.observed_count(), 1);
}

// The reference is a dense map updated voxel by voxel.
TEST(VoxelMap, UpdateAgreesWithBruteForce) {
  Random random(1);
  ThreadPool pool(2);
  VoxelMap dut(0.1);
  const OccupancyModel model;
  std::map<VoxelKey, LogOdds> reference;
  for (int scan = 0; scan < 20; ++scan) {
    ScanUpdate update;
    std::map<VoxelKey, int> marks;  // bit 0 free, 1 hit, 2 end
    for (int i = 0; i < 3000; ++i) {
      const VoxelKey key = RandomKey(random);
      switch (random.Integer(0, 5)) {
        case 0:
          update.MarkHit(key);
          marks[key] |= 2;
          break;
        case 1:
          update.MarkEnd(key);
          marks[key] |= 4;
          break;
        default:
          update.MarkFree(key);
          marks[key] |= 1;
      }
    }
    for (const auto& [key, bits] : marks) {
      if (bits & 2) {
        reference[key] = model.AfterHit(reference[key]);
      } else if (!(bits & 4)) {
        reference[key] = model.AfterMiss(reference[key]);
      }
    }
    dut.Update(update, pool);
  }
  std::int64_t occupied = 0;
  for (const auto& [key, value] : reference) {
    EXPECT_EQ(dut.Find(key), value);
    occupied += value >= 0;
  }
  EXPECT_EQ(dut.observed_count(), static_cast<std::int64_t>(reference.size()));
  EXPECT_EQ(dut.occupied_count(), occupied);
}

TEST(VoxelMap, ASaturatedMissCopiesNothing) {
  ThreadPool pool(1);
  VoxelMap dut(0.1);
  ScanUpdate update;
  update.MarkFree({1, 1, 1});
  for (int i = 0; i < 10; ++i) dut.Update(update, pool);
  const VoxelMap before = dut;
  dut.Update(update, pool);
  EXPECT_EQ(dut.blocks().Find({0, 0, 0}), before.blocks().Find({0, 0, 0}));
}

TEST(VoxelMap, ForgetsVoxelsInTheBoxAlone) {
  Random random(2);
  VoxelMap dut(0.1);
  for (int i = 0; i < 5000; ++i) dut.Set(RandomKey(random), 100);
  const VoxelMap before = dut;
  const Aabb box{{-0.5, -10, 0}, {0.55, 0.3, 1e9}};
  const std::int64_t forgotten = dut.Forget(box);
  const VoxelRange range = dut.grid().CentersIn(box);
  before.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach([&](int i) {
      const bool inside = range.Contains(VoxelAt(key, i));
      EXPECT_EQ(dut.State(VoxelAt(key, i)) == VoxelState::kUnknown, inside);
    });
  });
  EXPECT_LT(dut.observed_count(), before.observed_count());
  EXPECT_EQ(dut.observed_count(), before.observed_count() - forgotten);
  EXPECT_EQ(dut.Forget(box), 0);
}

TEST(VoxelMap, ForgettingAllIsTheEmptyMap) {
  VoxelMap dut(0.1);
  dut.Set({5, 5, 5}, 1);
  dut.Forget({{-1, -1, -1}, {1, 1, 1}});
  EXPECT_TRUE(dut == VoxelMap(0.1));
  EXPECT_EQ(dut.observed_count(), 0);
}

TEST(VoxelMap, ForgetsBlocksOutsideTheBoxAlone) {
  Random random(3);
  VoxelMap dut(0.1);
  for (int i = 0; i < 5000; ++i)
    dut.Set(RandomKey(random), static_cast<LogOdds>(i % 2 ? 100 : -100));
  const VoxelMap before = dut;
  const Aabb box{{-0.5, -1, 0.25}, {0.85, 0.3, 1e9}};
  dut.ForgetBlocksOutside(box);
  VoxelMap expected(0.1);
  before.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    const Eigen::Vector3d low = 0.8 * Eigen::Vector3d(key.x, key.y, key.z);
    const Aabb all{low, low + Eigen::Vector3d::Constant(0.8)};
    const bool meets =
        (all.max.array() > box.min.array()).all() && (all.min.array() <= box.max.array()).all();
    if (meets) expected.PutBlock(key, block);
  });
  EXPECT_TRUE(dut == expected);
  EXPECT_EQ(dut.observed_count(), expected.observed_count());
  EXPECT_EQ(dut.occupied_count(), expected.occupied_count());
  EXPECT_GT(expected.observed_count(), 10);
  EXPECT_LT(expected.observed_count(), before.observed_count() / 2);
}

TEST(VoxelMap, BoxesAreTight) {
  VoxelMap dut(0.5);
  dut.Set({-1, 2, 3}, -10);
  dut.Set({4, 2, 3}, 10);
  EXPECT_EQ(dut.ObservedBox(), (Aabb{{-0.5, 1, 1.5}, {2.5, 1.5, 2}}));
  EXPECT_EQ(dut.OccupiedBox(), (Aabb{{2, 1, 1.5}, {2.5, 1.5, 2}}));
}

TEST(VoxelMap, EqualityIgnoresHowTheContentsCameAbout) {
  VoxelMap a(0.1), b(0.1);
  a.Set({1, 1, 1}, 5);
  a.Set({100, 1, 1}, 6);
  b.Set({100, 1, 1}, 6);
  b.Set({1, 1, 1}, 4);
  EXPECT_FALSE(a == b);
  b.Set({1, 1, 1}, 5);
  EXPECT_TRUE(a == b);
  EXPECT_FALSE(a == VoxelMap(0.2));
}

TEST(VoxelMap, KeysOutOfRangeAreUnknown) {
  EXPECT_EQ(VoxelMap(0.1).State({kMaxVoxelIndex, 0, 0}), VoxelState::kUnknown);
}

}  // namespace
}  // namespace clearway
