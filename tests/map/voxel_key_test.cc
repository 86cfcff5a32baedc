#include "clearway/map/voxel_key.h"

#include <gtest/gtest.h>

#include <limits>

namespace clearway {
namespace {

TEST(VoxelKey, FloorsBelowZeroToo) {
  const VoxelGrid dut(0.5);
  EXPECT_EQ(dut.KeyOf({0.49, -0.01, -0.51}), (VoxelKey{0, -1, -2}));
}

TEST(VoxelKey, CenterAndBoxBelongToTheirVoxel) {
  const VoxelGrid dut(0.1);
  for (const VoxelKey key : {VoxelKey{0, 0, 0}, VoxelKey{-1, 7, -8}, VoxelKey{1000, -1000, 12}}) {
    EXPECT_EQ(dut.KeyOf(dut.CenterOf(key)), key);
    EXPECT_TRUE(dut.BoxOf(key).Contains(dut.CenterOf(key)));
    EXPECT_LT((dut.BoxOf(key).Center() - dut.CenterOf(key)).norm(), 1e-9);
  }
}

TEST(VoxelKey, BlockAndIndexGiveTheVoxelBack) {
  for (const VoxelKey key :
       {VoxelKey{0, 0, 0}, VoxelKey{-1, -1, -1}, VoxelKey{-8, 7, 8}, VoxelKey{123, -456, 789}}) {
    EXPECT_EQ(VoxelAt(BlockOf(key), IndexInBlock(key)), key);
    EXPECT_GE(IndexInBlock(key), 0);
    EXPECT_LT(IndexInBlock(key), 512);
  }
}

TEST(VoxelKey, ABoxHoldsTheVoxelsOfTheCentersInIt) {
  const VoxelGrid dut(0.1);
  const VoxelRange range = dut.CentersIn({{0, -0.16, 0.26}, {0.1, 0.06, 0.44}});
  EXPECT_EQ(range.first, (VoxelKey{0, -2, 3}));
  EXPECT_EQ(range.last, (VoxelKey{0, 0, 3}));
  EXPECT_EQ(range.count(), 3u);
  EXPECT_TRUE(range.Contains({0, -1, 3}));
  EXPECT_FALSE(range.Contains({0, 1, 3}));
  EXPECT_EQ(dut.CentersIn({{0.06, 0, 0}, {0.14, 1, 1}}).count(), 0u);  // between two centres
  EXPECT_EQ(dut.CentersIn(Aabb()).count(), 0u);
}

// 0.05, 0.15 and so on are no doubles, and no more are the centres.
TEST(VoxelKey, ABoxThatIsACenterHoldsItsVoxelAlone) {
  for (const double resolution_m : {0.1, 0.05, 0.07, 0.3}) {
    const VoxelGrid dut(resolution_m);
    for (std::int32_t i = -2000; i < 2000; ++i) {
      const VoxelKey key{i, -i, 7 * i};
      for (const double off : {-1e-7, 0.0, 1e-7}) {
        const Eigen::Vector3d p = dut.CenterOf(key).array() + off * resolution_m;
        const VoxelRange range = dut.CentersIn({p, p});
        EXPECT_EQ(range.count(), 1u);
        EXPECT_EQ(range.first, key);
      }
      const Eigen::Vector3d beside = dut.CenterOf(key).array() + 1e-5 * resolution_m;
      EXPECT_EQ(dut.CentersIn({beside, beside}).count(), 0u);
    }
  }
}

TEST(VoxelKey, ABoxLargerThanTheGridHoldsAllOfIt) {
  const VoxelRange all = VoxelGrid(0.1).CentersIn({{-1e12, -1e12, -1e12}, {1e12, 1e12, 1e12}});
  EXPECT_TRUE(InRange(all.first) && InRange(all.last));
  EXPECT_EQ(all.count(), std::uint64_t{1} << 63);
  EXPECT_EQ(VoxelGrid(0.1).CentersIn({{2e5, 0, 0}, {3e5, 1, 1}}).count(), 0u);
}

TEST(VoxelKey, AddressableExcludesWhatIsNotFinite) {
  const VoxelGrid dut(0.1);
  EXPECT_TRUE(dut.Addressable({dut.limit_m(), 0, 0}));
  EXPECT_TRUE(InRange(dut.KeyOf({dut.limit_m(), -dut.limit_m(), 0})));
  EXPECT_FALSE(dut.Addressable({dut.limit_m() * 1.01, 0, 0}));
  EXPECT_FALSE(dut.Addressable({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(dut.Addressable({0, std::numeric_limits<double>::infinity(), 0}));
}

}  // namespace
}  // namespace clearway
