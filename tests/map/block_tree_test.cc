#include "clearway/map/block_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
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

  std::vector<BlockKey> keys;
  for (int i = 0; i < 1000; ++i) keys.push_back(RandomKey(random));
  std::vector<const VoxelBlock*> found(keys.size());
  dut.FindAll(keys, found.data());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(found[i], dut.Find(keys[i]));
    EXPECT_EQ(found[i] != nullptr, reference.contains(keys[i]));
  }
}

TEST(BlockTree, FindOccupiedFindsBlocksWithOccupiedVoxelsAlone) {
  Random random(3);
  BlockTree dut;
  std::vector<BlockKey> keys;
  for (int i = 0; i < 1000; ++i) {
    keys.push_back(RandomKey(random));
    VoxelBlock block = BlockWith(0, 1);
    i % 2 == 0 ? block.occupied.Set(0) : block.occupied.Clear(0);
    if (i % 3 != 0) dut.Put(keys.back(), block);
  }
  std::vector<const VoxelBlock*> found(keys.size());
  dut.FindOccupied(keys, found.data());
  std::size_t count = 0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const VoxelBlock* block = dut.Find(keys[i]);
    EXPECT_EQ(found[i], block != nullptr && block->occupied.Any() ? block : nullptr);
    count += found[i] != nullptr;
  }
  EXPECT_GT(count, 200u);
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

TEST(BlockTree, KeysOutsideAreThoseNotInTheBox) {
  Random random(8);
  BlockTree dut;
  EXPECT_TRUE(dut.KeysOutside({0, 0, 0}, {0, 0, 0}).empty());
  for (int i = 0; i < 3000; ++i) dut.Put(RandomKey(random), BlockWith(0, 1));
  for (const auto& [low, high] : {std::pair<BlockKey, BlockKey>{{-3, -200, 0}, {5, 100, 3}},
                                  {{-64, -64, -64}, {63, 63, 63}},
                                  {{-4000, -4000, -4000}, {4000, 4000, 4000}}}) {
    std::vector<BlockKey> expected;
    dut.ForEach([&](BlockKey k, const VoxelBlock&) {
      if (k.x < low.x || k.y < low.y || k.z < low.z || k.x > high.x || k.y > high.y || k.z > high.z)
        expected.push_back(k);
    });
    EXPECT_EQ(dut.KeysOutside(low, high), expected);
  }
}

TEST(BlockTree, AnyBlockVisitsUntilItIsTrue) {
  Random random(7);
  BlockTree dut;
  EXPECT_FALSE(dut.AnyBlock([](BlockKey, const VoxelBlock&) { return true; }));
  for (int i = 0; i < 500; ++i) dut.Put(RandomKey(random), BlockWith(3, 1));
  std::vector<BlockKey> all, first;
  dut.ForEach([&](BlockKey key, const VoxelBlock&) { all.push_back(key); });
  EXPECT_FALSE(dut.AnyBlock([](BlockKey, const VoxelBlock&) { return false; }));
  EXPECT_TRUE(dut.AnyBlock([&](BlockKey key, const VoxelBlock&) {
    first.push_back(key);
    return first.size() == 100;
  }));
  all.resize(100);
  EXPECT_EQ(first, all);
}

TEST(BlockTree, AnyOccupiedInVisitsOccupiedBlocksInTheBox) {
  Random random(6);
  BlockTree dut;
  for (int i = 0; i < 4000; ++i) {  // many are overwritten: free, occupied, gone
    const int kind = random.Integer(0, 3);
    const BlockKey key = RandomKey(random);
    dut.Put(key, kind == 0 ? VoxelBlock{} : BlockWith(3, static_cast<LogOdds>(kind == 1 ? 1 : -1)));
  }
  for (int box = 0; box < 200; ++box) {
    const BlockKey a = RandomKey(random), b = RandomKey(random);
    const BlockKey low{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    const BlockKey high{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    std::vector<BlockKey> expected, visited;
    dut.ForEachIn(low, high, [&](BlockKey key, const VoxelBlock& block) {
      if (block.occupied.Any()) expected.push_back(key);
    });
    const bool stopped = dut.AnyOccupiedIn(low, high, [&](BlockKey key, const VoxelBlock& block) {
      EXPECT_EQ(&block, dut.Find(key));
      visited.push_back(key);
      return visited.size() == 20;
    });
    EXPECT_EQ(stopped, expected.size() >= 20);
    if (expected.size() > 20) expected.resize(20);
    EXPECT_EQ(visited, expected);
  }
}

TEST(BlockTree, PutAllIsManyPuts) {
  ThreadPool pool(3);
  Random random(7);
  BlockTree dut, reference;
  for (int i = 0; i < 1000; ++i) dut.Put(RandomKey(random), BlockWith(1, 1));
  reference = dut;
  const BlockTree before = dut;
  std::set<BlockKey> distinct;
  while (distinct.size() < 1000) distinct.insert(RandomKey(random));
  const std::vector<BlockKey> keys(distinct.begin(), distinct.end());
  dut.PutAll(keys, pool, [&](int, std::size_t i, const VoxelBlock& old, VoxelBlock& block) {
    const VoxelBlock* stored = before.Find(keys[i]);
    EXPECT_EQ(old, stored == nullptr ? VoxelBlock{} : *stored);
    block = i % 3 == 0 ? VoxelBlock{} : BlockWith(2, static_cast<LogOdds>(i));
    return i % 5 != 0;
  });
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i % 5 == 0) continue;
    reference.Put(keys[i], i % 3 == 0 ? VoxelBlock{} : BlockWith(2, static_cast<LogOdds>(i)));
  }
  EXPECT_EQ(Contents(dut), Contents(reference));
  EXPECT_EQ(dut.size(), reference.size());
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
