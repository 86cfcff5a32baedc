#include "map/bit_window.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

std::map<BlockKey, std::set<int>> TakeAll(BitWindow& window) {
  std::vector<BitWindow::Block> blocks;
  for (std::size_t row = 0; row < window.rows(); ++row) window.TakeRow(row, blocks);
  std::map<BlockKey, std::set<int>> taken;
  for (const BitWindow::Block& block : blocks) {
    EXPECT_TRUE(block.mask.Any());
    block.mask.ForEach([&](int i) { taken[block.key].insert(i); });
  }
  return taken;
}

TEST(BitWindow, Empty) {
  BitWindow dut;
  dut.Cover({-1, 0, 3}, {4, 2, 3});
  EXPECT_TRUE(TakeAll(dut).empty());
}

TEST(BitWindow, StridesLeadToTheNeighbours) {
  BitWindow dut;
  dut.Cover({-3, -2, -1}, {4, 5, 6});
  const VoxelKey key{-5, 7, 11};
  EXPECT_EQ(dut.IndexOf({-4, 7, 11}) - dut.IndexOf(key), dut.strides()[0]);
  EXPECT_EQ(dut.IndexOf({-5, 8, 11}) - dut.IndexOf(key), dut.strides()[1]);
  EXPECT_EQ(dut.IndexOf({-5, 7, 12}) - dut.IndexOf(key), dut.strides()[2]);
}

TEST(BitWindow, GivesWhatIsSetBlockByBlockAndIsThenClear) {
  const BlockKey first{-3, -1, 2}, last{6, 2, 4};
  BitWindow dut;
  Random random(1);
  for (int round = 0; round < 3; ++round) {
    std::map<BlockKey, std::set<int>> expected;
    dut.Cover(first, last);
    for (int i = 0; i < 400; ++i) {
      const VoxelKey key{random.Integer(8 * first.x, 8 * last.x + 7),
                         random.Integer(8 * first.y, 8 * last.y + 7),
                         random.Integer(8 * first.z, 8 * last.z + 7)};
      dut.Set(key);
      expected[BlockOf(key)].insert(IndexInBlock(key));
    }
    EXPECT_EQ(TakeAll(dut), expected);
    EXPECT_TRUE(TakeAll(dut).empty());
  }
}

TEST(BitWindow, ClearsAndTellsOfSomeVoxelsOfABlockAlone) {
  const BlockKey first{-3, -1, 2}, last{6, 2, 4};
  BitWindow dut;
  dut.Cover(first, last);
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    BitWindow::Block block{{random.Integer(-3, 6), random.Integer(-1, 2), random.Integer(2, 4)},
                           {}};
    std::map<BlockKey, std::set<int>> expected;
    BlockMask set;
    for (int i = 0; i < kVoxelsPerBlock; ++i) {
      if (random.Integer(0, 4) == 0) block.mask.Set(i);
      if (random.Integer(0, 1) == 0) continue;
      dut.Set(VoxelAt(block.key, i));
      if (block.mask.Test(i)) {
        set.Set(i);
      } else {
        expected[block.key].insert(i);
      }
    }
    const VoxelKey beside = VoxelAt({block.key.x == 6 ? -3 : block.key.x + 1, 0, 3}, 77);
    dut.Set(beside);
    expected[BlockOf(beside)].insert(77);
    EXPECT_EQ(dut.SetOf(block), set);
    dut.Clear(block);
    EXPECT_FALSE(dut.SetOf(block).Any());
    EXPECT_EQ(TakeAll(dut), expected);
  }
}

TEST(BitWindow, AllSetAsVoxelByVoxel) {
  BitWindow dut;
  dut.Cover({-2, -1, 0}, {9, 1, 1});
  Random random(2);
  for (int x = -16; x < 80; ++x) {
    for (int y = -8; y < 16; ++y) {
      for (int z = 0; z < 16; ++z) {
        if (random.Integer(0, 199) != 0) dut.Set({x, y, z});
      }
    }
  }
  int all = 0;
  for (int i = 0; i < 5000; ++i) {
    const VoxelKey min{random.Integer(-18, 79), random.Integer(-9, 15), random.Integer(-1, 15)};
    const VoxelKey max{min.x + random.Integer(0, i % 4 == 0 ? 70 : 3), min.y + random.Integer(0, 2),
                       min.z + random.Integer(0, 2)};
    bool expected =
        min.x >= -16 && min.y >= -8 && min.z >= 0 && max.x < 80 && max.y < 16 && max.z < 16;
    for (int x = min.x; x <= max.x; ++x) {
      for (int y = min.y; y <= max.y; ++y) {
        for (int z = min.z; z <= max.z; ++z) expected = expected && dut.Test({x, y, z});
      }
    }
    ASSERT_EQ(dut.AllSet(min, max), expected);
    all += expected;
  }
  EXPECT_GT(all, 500);
}

TEST(BitWindow, DoesNotFitTheWholeWorld) {
  EXPECT_TRUE(BitWindow::Fits({-70, -70, -10}, {70, 70, 10}));
  constexpr std::int32_t kFar = kMaxVoxelIndex / kBlockSize;
  EXPECT_FALSE(BitWindow::Fits({-kFar, -kFar, -kFar}, {kFar, kFar, kFar}));
  EXPECT_FALSE(BitWindow::Fits({-kFar, 0, 0}, {kFar, kFar, 0}));
}

}  // namespace
}  // namespace clearway
