#include "map/block_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

namespace clearway {
namespace {

// Every piece is filled with a value of its own, so that shared memory would show.
std::vector<void*> TakeAndFill(int count, int value) {
  std::vector<void*> pieces;
  for (int i = 0; i < count; ++i) {
    pieces.push_back(TakeBlockMemory());
    std::memset(pieces.back(), value, kBlockMemoryBytes);
  }
  return pieces;
}

bool HoldOnly(const std::vector<void*>& pieces, int value) {
  for (const void* piece : pieces) {
    const auto* bytes = static_cast<const unsigned char*>(piece);
    for (std::size_t i = 0; i < kBlockMemoryBytes; ++i) {
      if (bytes[i] != value) return false;
    }
  }
  return true;
}

void GiveBack(const std::vector<void*>& pieces) {
  for (void* piece : pieces) GiveBackBlockMemory(piece);
}

TEST(BlockMemory, PiecesAreApartAndAligned) {
  const std::vector<void*> pieces = TakeAndFill(5000, 7);
  EXPECT_EQ(std::set<void*>(pieces.begin(), pieces.end()).size(), pieces.size());
  for (const void* piece : pieces) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(piece) % 64, 0u);
  GiveBack(pieces);
}

TEST(BlockMemory, OneThreadGivesBackWhatAnotherTook) {
  for (int round = 0; round < 5; ++round) {
    std::vector<std::vector<void*>> taken(4);
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&taken, t] {
        GiveBack(TakeAndFill(700, 100 + t));
        taken[t] = TakeAndFill(3000, t);
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (int t = 0; t < 4; ++t) EXPECT_TRUE(HoldOnly(taken[t], t));
    for (const std::vector<void*>& pieces : taken) GiveBack(pieces);
  }
}

TEST(BlockMemory, WhatAnotherThreadGaveBackIsTakenAgain) {
  constexpr int kPieces = 20000;
  std::set<void*> before;
  for (void* piece : TakeAndFill(kPieces, 1)) before.insert(piece);
  std::thread([&] { GiveBack({before.begin(), before.end()}); }).join();
  const std::vector<void*> pieces = TakeAndFill(kPieces, 2);
  std::size_t again = 0;
  for (void* piece : pieces) again += before.count(piece);
  GiveBack(pieces);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(again, kPieces * 9 / 10);  // all but what the other thread keeps at hand
#endif
}

}  // namespace
}  // namespace clearway
