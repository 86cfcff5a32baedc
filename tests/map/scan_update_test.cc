#include "clearway/map/scan_update.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(ScanUpdate, Empty) {
  const ScanUpdate dut;
  EXPECT_TRUE(dut.Empty());
  EXPECT_EQ(dut.Find({0, 0, 0}), nullptr);
  EXPECT_TRUE(dut.keys().empty());
}

TEST(ScanUpdate, MarksInTheRightBlock) {
  ScanUpdate dut;
  dut.MarkFree({-1, 0, 0});
  dut.MarkHit({8, 0, 0});
  dut.MarkEnd({9, 0, 0});
  EXPECT_EQ(dut.keys(), (std::vector<BlockKey>{{-1, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(dut.block(0).free.Test(7));
  EXPECT_TRUE(dut.Find({-1, 0, 0})->free.Test(7));
  EXPECT_EQ(dut.Find({-1, 0, 0})->free.Count(), 1);
  EXPECT_EQ(dut.Find({1, 0, 0})->hit.Count(), 1);
  EXPECT_EQ(dut.Find({1, 0, 0})->end.Count(), 2);
}

TEST(ScanUpdate, KnowsWhereRaysEnd) {
  ScanUpdate dut;
  dut.MarkFree({0, 0, 0});
  dut.MarkEnd({8, 0, 0});
  dut.MarkHit({0, 9, 0});
  dut.MarkFree({0, 0, 9});
  dut.MarkHit({9, 0, 0});
  dut.TakeHit({0, 9, 0});
  EXPECT_EQ(dut.end_places(), (std::vector<std::size_t>{1, 2}));
  BlockMask mask;
  mask.Set(5);
  dut.MarkEnd(BlockKey{0, 0, 1}, mask);
  EXPECT_EQ(dut.end_places(), (std::vector<std::size_t>{1, 2, 3}));
}

}  // namespace
}  // namespace clearway
