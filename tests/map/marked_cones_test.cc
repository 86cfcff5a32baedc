#include "map/marked_cones.h"

#include <gtest/gtest.h>

#include <limits>

namespace clearway {
namespace {

const VoxelGrid kGrid(0.1);

// A window of 3.2 m to each side, marked all over but for one voxel.
BitWindow AllBut(VoxelKey left_out) {
  BitWindow window;
  window.Cover({-4, -4, -4}, {3, 3, 3});
  for (int x = -32; x < 32; ++x) {
    for (int y = -32; y < 32; ++y) {
      for (int z = -32; z < 32; ++z) {
        if (VoxelKey{x, y, z} != left_out) window.Set({x, y, z});
      }
    }
  }
  return window;
}

// The direction in the last lane, others in the rest.
double DepthM(MarkedCones& dut, const Eigen::Vector3f& direction, const BitWindow& window) {
  LaneFloats lanes[3];
  for (int lane = 0; lane < kLanes; ++lane) {
    const float other = static_cast<float>(kLanes - 1 - lane);  // 0 in the last
    for (int axis = 0; axis < 3; ++axis) {
      lanes[axis][lane] = direction[axis] + (axis == 0 ? 10 : axis) * other;
    }
  }
  LaneDoubles depths_m;
  dut.FindDepths(lanes, window, depths_m);
  return depths_m[kLanes - 1];
}

TEST(MarkedCones, EndsBeforeTheVoxelThatIsNotMarked) {
  const BitWindow window = AllBut({20, 0, 0});
  MarkedCones dut(kGrid, {0.05, 0.05, 0.05}, 0, false, 16);
  EXPECT_NEAR(DepthM(dut, {1, 0.001f, 0.001f}, window), 1.95, 0.01);  // 20 layers
  EXPECT_LT(DepthM(dut, {1, 0.001f, 0.001f}, window), 1.95);
  EXPECT_NEAR(DepthM(dut, {1, -0.6f, 0.3f}, window), 3.15, 0.1);  // to the window's end
}

TEST(MarkedCones, LooksAgainInTheNextRoundAlone) {
  BitWindow window = AllBut({20, 0, 0});
  MarkedCones dut(kGrid, {0.05, 0.05, 0.05}, 0, false, 16);
  const double before_m = DepthM(dut, {1, 0, 0}, window);
  window.Set({20, 0, 0});
  EXPECT_EQ(DepthM(dut, {1, 0, 0}, window), before_m);
  dut.NextRound();
  EXPECT_GT(DepthM(dut, {1, 0, 0}, window), before_m + 0.9);
}

// Rays of one sign along an axis never reach the voxels behind the origin's, which other rays mark.
TEST(MarkedCones, ASensorOnABorderNeedsNothingBehindIt) {
  BitWindow window;
  window.Cover({-4, -4, -4}, {3, 3, 3});
  for (int x = 0; x < 32; ++x) {
    for (int y = 0; y < 32; ++y) {
      for (int z = 0; z < 32; ++z) window.Set({x, y, z});
    }
  }
  MarkedCones dut(kGrid, {0, 0, 0}, 0, false, 16);
  EXPECT_GT(DepthM(dut, {1, 0.1f, 0.2f}, window), 2.5);
  EXPECT_GT(DepthM(dut, {1, 0, 0}, window), 2.5);
  EXPECT_LE(DepthM(dut, {1, -0.1f, 0.2f}, window), 0);
}

TEST(MarkedCones, TakesDirectionsWithoutASlope) {
  const BitWindow window = AllBut({20, 0, 0});
  MarkedCones dut(kGrid, {0.05, 0.05, 0.05}, 0, false, 16);
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  EXPECT_GE(DepthM(dut, {0, 0, 0}, window), 0);
  EXPECT_GE(DepthM(dut, {kTiny, kTiny, -kTiny}, window), 0);
}

}  // namespace
}  // namespace clearway
