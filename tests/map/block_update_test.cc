#include "map/block_update.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// The rule, voxel by voxel.
VoxelBlock ByTheRule(const ScanUpdate::Block& scan, const OccupancyModel& model, VoxelBlock block) {
  for (int i = 0; i < kVoxelsPerBlock; ++i) {
    if (scan.hit.Test(i)) {
      block.Set(i, model.AfterHit(block.log_odds[i]), model);
    } else if (scan.free.Test(i) && !scan.end.Test(i)) {
      block.Set(i, model.AfterMiss(block.log_odds[i]), model);
    }
  }
  return block;
}

ScanUpdate::Block RandomScan(Random& random) {
  ScanUpdate::Block scan;
  const int share = random.Integer(1, 20);
  for (int i = 0; i < kVoxelsPerBlock; ++i) {
    if (random.Integer(0, share) == 0) scan.free.Set(i);
    if (random.Integer(0, 30) == 0) scan.hit.Set(i);
    if (scan.hit.Test(i) || random.Integer(0, 30) == 0) scan.end.Set(i);
  }
  return scan;
}

TEST(BlockUpdate, EmptyScanChangesNothing) {
  VoxelBlock dut;
  dut.Set(3, 100, {});
  VoxelBlock after;
  EXPECT_FALSE(ApplyScan({}, {}, dut, after));
  EXPECT_EQ(after, dut);
}

TEST(BlockUpdate, IsTheRuleVoxelByVoxel) {
  // The last one: what a miss is the first to observe is occupied.
  for (const OccupancyProbabilities& probabilities :
       {OccupancyProbabilities{}, OccupancyProbabilities{0.9, 0.1, 0.0005, 0.9995, 0.5},
        OccupancyProbabilities{0.7, 0.4, 0.1192, 0.971, 0.3}}) {
    ASSERT_TRUE(Validate(probabilities).ok());
    const OccupancyModel model(probabilities);
    Random random(1);
    VoxelBlock dut;
    for (int scan = 0; scan < 300; ++scan) {
      const ScanUpdate::Block marks = RandomScan(random);
      const VoxelBlock expected = ByTheRule(marks, model, dut);
      VoxelBlock after;
      ASSERT_EQ(ApplyScan(marks, model, dut, after), expected != dut) << "scan " << scan;
      ASSERT_EQ(after, expected) << "scan " << scan;
      dut = after;
    }
  }
}

}  // namespace
}  // namespace clearway
