#include "map/node_memory.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <type_traits>
#include <vector>

#include "clearway/map/map_memory.h"

namespace clearway {
namespace {

// For nodes of one size.
template <class Bytes>
class NodeMemory : public ::testing::Test {
 protected:
  using Pieces = std::vector<void*>;

  // Every piece is filled with a value of its own, so that shared memory would show.
  static Pieces TakeAndFill(int count, int value) {
    Pieces pieces;
    for (int i = 0; i < count; ++i) {
      pieces.push_back(TakeNodeMemory<Bytes::value>());
      std::memset(pieces.back(), value, Bytes::value);
    }
    return pieces;
  }

  static bool HoldOnly(const Pieces& pieces, int value) {
    for (const void* piece : pieces) {
      const auto* bytes = static_cast<const unsigned char*>(piece);
      for (std::size_t i = 0; i < Bytes::value; ++i) {
        if (bytes[i] != value) return false;
      }
    }
    return true;
  }

  static void GiveBack(const Pieces& pieces) {
    for (void* piece : pieces) GiveBackNodeMemory<Bytes::value>(piece);
  }
};
using Sizes = ::testing::Types<std::integral_constant<std::size_t, kBlockMemoryBytes>,
                               std::integral_constant<std::size_t, kBranchMemoryBytes>>;
TYPED_TEST_SUITE(NodeMemory, Sizes);

TYPED_TEST(NodeMemory, PiecesAreApartAndAligned) {
  const std::vector<void*> pieces = TestFixture::TakeAndFill(5000, 7);
  EXPECT_EQ(std::set<void*>(pieces.begin(), pieces.end()).size(), pieces.size());
  for (const void* piece : pieces) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(piece) % 64, 0u);
  TestFixture::GiveBack(pieces);
}

TYPED_TEST(NodeMemory, OneThreadGivesBackWhatAnotherTook) {
  for (int round = 0; round < 5; ++round) {
    std::vector<std::vector<void*>> taken(4);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&taken, t] {
        TestFixture::GiveBack(TestFixture::TakeAndFill(700, 100 + t));
        taken[t] = TestFixture::TakeAndFill(3000, t);
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (int t = 0; t < 4; ++t) EXPECT_TRUE(TestFixture::HoldOnly(taken[t], t));
    for (const std::vector<void*>& pieces : taken) TestFixture::GiveBack(pieces);
  }
}

TYPED_TEST(NodeMemory, WhatAnotherThreadGaveBackIsTakenAgain) {
  constexpr int kPieces = 20000;
  std::set<void*> before;
  for (void* piece : TestFixture::TakeAndFill(kPieces, 1)) before.insert(piece);
  std::thread([&] { TestFixture::GiveBack({before.begin(), before.end()}); }).join();
  const std::vector<void*> pieces = TestFixture::TakeAndFill(kPieces, 2);
  std::size_t again = 0;
  for (void* piece : pieces) again += before.count(piece);
  TestFixture::GiveBack(pieces);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(again, kPieces * 9 / 10);  // all but what the other thread keeps at hand
#endif
}

// Also when pieces of the same pages are in use.
TYPED_TEST(NodeMemory, WhatIsTrimmedIsTheSystemsAndTheRestIsLeftAlone) {
  constexpr int kPieces = 20000;
  const std::uint64_t in_use = CurrentMapMemory().in_use_bytes;
  const std::vector<void*> kept = TestFixture::TakeAndFill(kPieces, 3);
  const std::vector<void*> given = TestFixture::TakeAndFill(kPieces, 4);
  EXPECT_EQ(CurrentMapMemory().in_use_bytes, in_use + 2 * kPieces * TypeParam::value);
  TestFixture::GiveBack(given);
  EXPECT_EQ(CurrentMapMemory().in_use_bytes, in_use + kPieces * TypeParam::value);
  TrimMapMemory();
#if !defined(__SANITIZE_ADDRESS__)
  // Of each size, the page between the two and what waited before.
  EXPECT_LT(CurrentMapMemory().waiting_bytes, kPieces * TypeParam::value / 2);
#endif
  EXPECT_TRUE(TestFixture::HoldOnly(kept, 3));
  TestFixture::GiveBack(TestFixture::TakeAndFill(kPieces, 5));
  EXPECT_TRUE(TestFixture::HoldOnly(kept, 3));
  TestFixture::GiveBack(kept);
  EXPECT_EQ(CurrentMapMemory().in_use_bytes, in_use);
}

TYPED_TEST(NodeMemory, IsTrimmedWhileOtherThreadsUseIt) {
  std::atomic<bool> ended = false;
  std::thread trimmer([&] {
    while (!ended) TrimMapMemory();
  });
  for (int round = 0; round < 20; ++round) {
    const std::vector<void*> pieces = TestFixture::TakeAndFill(3000, round);
    EXPECT_TRUE(TestFixture::HoldOnly(pieces, round));
    TestFixture::GiveBack(pieces);
  }
  ended = true;
  trimmer.join();
}

}  // namespace
}  // namespace clearway
