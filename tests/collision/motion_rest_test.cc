#include "clearway/collision/motion_rest.h"

#include <gtest/gtest.h>

#include "collision/test_world.h"

namespace clearway {
namespace {

// A link that goes 1 m a second along x in two knots a motion, and one that stands still.
MotionBatch TwoMotions() {
  MotionBatch motions;
  motions.knot_counts = {3, 2};
  for (const double second : {0, 1, 2, 5, 6}) {
    motions.times.push_back(TestTime(second));
    motions.T_W_L.push_back(Pose::Translation(second, 0, 0));
    motions.T_W_L.push_back(Pose::Translation(7, 8, 9));
    motions.deviations_m.push_back(0.1 * second);
    motions.deviations_m.push_back(0);
  }
  return motions;
}

TEST(RestOf, BeforeTheyBeginItIsAll) {
  const MotionBatch all = TwoMotions();
  const MotionRest dut = RestOf(all, 2, TestTime(-1));
  EXPECT_EQ(dut.motions.knot_counts, all.knot_counts);
  EXPECT_EQ(dut.motions.times, all.times);
  EXPECT_EQ(dut.motions.T_W_L, all.T_W_L);
  EXPECT_EQ(dut.motions.deviations_m, all.deviations_m);
  EXPECT_EQ(dut.indices, (std::vector<std::size_t>{0, 1}));
}

TEST(RestOf, OnTheWayItBeginsWhereTheRobotIs) {
  const MotionRest dut = RestOf(TwoMotions(), 2, TestTime(1.5));
  EXPECT_EQ(dut.motions.knot_counts, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(dut.motions.times[0], TestTime(1.5));
  EXPECT_NEAR(dut.motions.T_W_L[0].translation.x(), 1.5, 1e-12);
  EXPECT_EQ(dut.motions.T_W_L[1].translation, Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(dut.motions.deviations_m[0], 0.1);  // of the leg it is on
  EXPECT_EQ(dut.motions.times[1], TestTime(2));
}

TEST(RestOf, AtAKnotItBeginsThere) {
  const MotionRest dut = RestOf(TwoMotions(), 2, TestTime(1));
  EXPECT_EQ(dut.motions.knot_counts[0], 2u);
  EXPECT_EQ(dut.motions.times[0], TestTime(1));
  EXPECT_NEAR(dut.motions.T_W_L[0].translation.x(), 1, 1e-12);
}

TEST(RestOf, WhatIsOverIsLeftOut) {
  const MotionRest dut = RestOf(TwoMotions(), 2, TestTime(2));
  EXPECT_EQ(dut.indices, std::vector<std::size_t>{1});
  EXPECT_EQ(dut.motions.knot_counts, std::vector<std::size_t>{2});
  EXPECT_TRUE(RestOf(TwoMotions(), 2, TestTime(6)).indices.empty());
}

TEST(RestOf, OfNoMotionsIsNone) {
  const MotionRest dut = RestOf({}, 2, TestTime(0));
  EXPECT_TRUE(dut.motions.times.empty());
  EXPECT_TRUE(dut.indices.empty());
}

}  // namespace
}  // namespace clearway
