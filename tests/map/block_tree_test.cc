#include "clearway/map/block_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <thread>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

VoxelBlock BlockWith(int index, LogOdds value) {
  VoxelBlock block;
  block.Set(index, value, OccupancyModel());
  return block;
}

std::map<BlockKey, VoxelBlock> Contents(const BlockTree& tree) {
  std::map<BlockKey, VoxelBlock> contents;
  tree.ForEach([&](BlockKey key, const VoxelBlock& block) {
    EXPECT_TRUE(contents.emplace(key, block).second) << "visited twice";
  });
  return contents;
}

BlockKey RandomKey(Random& random) {
  const int span = random.Integer(0, 3) == 0 ? 2000 : 6;
  const int x = random.Integer(-span, span), y = random.Integer(-span, span);
  return {x, y, random.Integer(-span, span)};
}

TEST(BlockTree, Empty) {
  const BlockTree dut;
  EXPECT_EQ(dut.size(), 0u);
  EXPECT_EQ(dut.Find({0, 0, 0}), nullptr);
  EXPECT_TRUE(Contents(dut).empty());
}

TEST(BlockTree, FindsWhatWasPut) {
  BlockTree dut;
  dut.Put({-1, 63, 64}, BlockWith(5, 7));
  ASSERT_NE(dut.Find({-1, 63, 64}), nullptr);
  EXPECT_EQ(*dut.Find({-1, 63, 64}), BlockWith(5, 7));
  EXPECT_EQ(dut.Find({-1, 63, 63}), nullptr);
}

TEST(BlockTree, AgreesWithAMapOverRandomPutsAndRemovals) {
  Random random(1);
  BlockTree dut;
  std::map<BlockKey, VoxelBlock> reference;
  for (int i = 0; i < 5000; ++i) {
    const BlockKey key = RandomKey(random);
    if (random.Integer(0, 2) == 0) {
      dut.Put(key, VoxelBlock{});
      reference.erase(key);
    } else {
      const VoxelBlock block = BlockWith(random.Integer(0, 511), static_cast<LogOdds>(i));
      dut.Put(key, block);
      reference[key] = block;
    }
  }
  EXPECT_EQ(dut.size(), reference.size());
  EXPECT_EQ(Contents(dut), reference);
}

TEST(BlockTree, ForEachInVisitsTheBoxAlone) {
  Random random(2);
  BlockTree dut;
  for (int i = 0; i < 2000; ++i) dut.Put(RandomKey(random), BlockWith(0, 1));
  const BlockKey low{-3, -200, 0}, high{5, 100, 3};
  std::size_t expected = 0, visited = 0;
  dut.ForEach([&](BlockKey k, const VoxelBlock&) {
    expected += k.x >= low.x && k.y >= low.y && k.z >= low.z && k.x <= high.x && k.y <= high.y &&
                k.z <= high.z;
  });
  dut.ForEachIn(low, high, [&](BlockKey k, const VoxelBlock&) {
    EXPECT_TRUE(k.x >= low.x && k.y >= low.y && k.z >= low.z && k.x <= high.x && k.y <= high.y &&
                k.z <= high.z);
    ++visited;
  });
  EXPECT_EQ(visited, expected);
  EXPECT_GT(visited, 10u);
}

TEST(BlockTree, WritingToACopyLeavesTheOriginal) {
  Random random(3);
  BlockTree dut;
  for (int i = 0; i < 500; ++i) dut.Put(RandomKey(random), BlockWith(1, 1));
  const BlockTree before = dut;
  const auto contents = Contents(before);
  for (int i = 0; i < 500; ++i) dut.Put(RandomKey(random), i % 2 ? BlockWith(2, 2) : VoxelBlock{});
  EXPECT_EQ(Contents(before), contents);
  EXPECT_NE(Contents(dut), contents);
}

TEST(BlockTree, DifferenceIsExactlyWhatWasWritten) {
  Random random(4);
  BlockTree before;
  for (int i = 0; i < 1000; ++i) before.Put(RandomKey(random), BlockWith(1, 1));
  BlockTree after = before;
  for (int i = 0; i < 300; ++i)
    after.Put(RandomKey(random), i % 3 ? BlockWith(2, 2) : VoxelBlock{});
  auto patched = Contents(before);
  int visited = 0;
  BlockTree::ForEachDifference(before, after,
                               [&](BlockKey key, const VoxelBlock* b, const VoxelBlock* a) {
                                 ++visited;
                                 EXPECT_EQ(b, before.Find(key));
                                 EXPECT_EQ(a, after.Find(key));
                                 if (a == nullptr)
                                   patched.erase(key);
                                 else
                                   patched[key] = *a;
                               });
  EXPECT_EQ(patched, Contents(after));
  EXPECT_LE(visited, 300);
}

TEST(BlockTree, NoDifferenceBetweenCopies) {
  BlockTree dut;
  dut.Put({1, 2, 3}, BlockWith(0, 1));
  const BlockTree copy = dut;
  BlockTree::ForEachDifference(dut, copy,
                               [](BlockKey, const VoxelBlock*, const VoxelBlock*) { FAIL(); });
}

TEST(BlockTree, ACopyIsReadWhileTheOriginalIsWritten) {
  BlockTree dut;
  for (int i = 0; i < 200; ++i) dut.Put({i, 0, 0}, BlockWith(0, 1));
  std::thread reader([copy = dut] {
    for (int round = 0; round < 50; ++round) {
      copy.ForEach([](BlockKey, const VoxelBlock& block) { EXPECT_EQ(block.log_odds[0], 1); });
    }
  });
  for (int round = 2; round < 50; ++round) {
    for (int i = 0; i < 200; ++i) dut.Put({i, 0, 0}, BlockWith(0, static_cast<LogOdds>(round)));
  }
  reader.join();
}

}  // namespace
}  // namespace clearway
