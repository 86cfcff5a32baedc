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
