#include "clearway/sim/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

constexpr double kPi = std::numbers::pi;

Time At(double seconds) { return Time(FromSeconds(seconds)); }

Pose Yawed(double x, double y, double yaw) {
  return {Exp({{0, 0, yaw}, Eigen::Vector3d::Zero()}).rotation, {x, y, 0}};
}

void ExpectNear(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  EXPECT_LT((a.translation - b.translation).norm(), tolerance);
  EXPECT_LT(a.rotation.angularDistance(b.rotation), tolerance);
}

TEST(TrajectoryTest, EmptyStandsAtTheOrigin) {
  const Trajectory dut;
  EXPECT_EQ(PoseAt(dut, At(5)), Pose());
}

TEST(TrajectoryTest, FixedPoseNeverMoves) {
  const Trajectory dut = FixedPose{Yawed(1, 2, 3)};
  EXPECT_EQ(PoseAt(dut, At(-4)), PoseAt(dut, At(4000)));
}

TEST(TrajectoryTest, ConstantTwistRunsRoundACircle) {
  // 1 m/s forward at 1 rad/s: a circle of radius 1 m about (0, 1).
  const Trajectory dut = ConstantTwist{Pose(), {{0, 0, 1}, {1, 0, 0}}, At(10)};
  for (const double s : {-3.0, 0.0, 0.7, 5.0, 100.0}) {
    ExpectNear(PoseAt(dut, At(10 + s)), Yawed(std::sin(s), 1 - std::cos(s), s), 1e-11);
  }
}

TEST(TrajectoryTest, WaypointsArePassedAndHeld) {
  const Trajectory dut = WaypointPath{{{At(1), Yawed(0, 0, 0)},
                                       {At(2), Yawed(2, 0, 0)},
                                       {At(3), Yawed(2, 0, 0)},
                                       {At(4), Yawed(2, 0, 1)}}};
  ExpectNear(PoseAt(dut, At(0)), Yawed(0, 0, 0));
  ExpectNear(PoseAt(dut, At(1.25)), Yawed(0.5, 0, 0));
  ExpectNear(PoseAt(dut, At(2)), Yawed(2, 0, 0));
  ExpectNear(PoseAt(dut, At(2.5)), Yawed(2, 0, 0));
  ExpectNear(PoseAt(dut, At(3.5)), Yawed(2, 0, 0.5));
  ExpectNear(PoseAt(dut, At(9)), Yawed(2, 0, 1));
}

TEST(TrajectoryTest, APathWithoutWaypointsStandsAtTheOrigin) {
  EXPECT_EQ(PoseAt(WaypointPath{}, At(1)), Pose());
}

TEST(TrajectoryTest, DriveComesAndGoesStraight) {
  const Trajectory dut = Drive{.T_W_B = Yawed(5, 0, 0),
                               .start_speed_mps = 2,
                               .legs = {{FromSeconds(1), 4, 0}},
                               .start = At(1)};
  ExpectNear(PoseAt(dut, At(0)), Yawed(3, 0, 0));
  ExpectNear(PoseAt(dut, At(1.5)), Yawed(5 + 1.25, 0, 0));  // 2 * 0.5 + 0.5 * 2 * 0.25
  ExpectNear(PoseAt(dut, At(2)), Yawed(8, 0, 0));
  ExpectNear(PoseAt(dut, At(4)), Yawed(16, 0, 0));
}

TEST(TrajectoryTest, DriveTurnsOnAnArc) {
  // A quarter turn to the left of radius 10 m.
  const double seconds = 10 * kPi / 2 / 5;
  const Trajectory dut = Drive{.T_W_B = Pose(),
                               .start_speed_mps = 5,
                               .legs = {{FromSeconds(seconds), 5, kPi / 2}},
                               .start = At(0)};
  ExpectNear(PoseAt(dut, At(seconds)), Yawed(10, 10, kPi / 2), 1e-8);
  ExpectNear(PoseAt(dut, At(seconds + 2)), Yawed(10, 20, kPi / 2), 1e-8);
}

TEST(TrajectoryTest, DriveTurnsOnTheSpotWhenItStands) {
  const Trajectory dut = Drive{.legs = {{FromSeconds(2), 0, 1}}, .start = At(0)};
  ExpectNear(PoseAt(dut, At(1)), Yawed(0, 0, 0.5));
  ExpectNear(PoseAt(dut, At(7)), Yawed(0, 0, 1));
}

TEST(TrajectoryTest, DriveHasNoJumps) {
  const Trajectory dut = Drive{.T_W_B = Yawed(1, 2, 0.3),
                               .start_speed_mps = 3,
                               .legs = {{FromSeconds(1), 5, 1},
                                        {FromSeconds(2), 0, -0.4},
                                        {FromSeconds(1), 0, 0},
                                        {FromSeconds(1), 2, 0.2}},
                               .start = At(0)};
  Pose last = PoseAt(dut, At(-1));
  for (double s = -1; s < 7; s += 0.001) {
    const Pose pose = PoseAt(dut, At(s));
    EXPECT_LT((pose.translation - last.translation).norm(), 0.0051);
    EXPECT_LT(pose.rotation.angularDistance(last.rotation), 0.0021);
    last = pose;
  }
}

TEST(TrajectoryTest, LengthOfADriveIsWhatItCovers) {
  const Drive dut{.start_speed_mps = 2, .legs = {{FromSeconds(3), 4, 1}, {FromSeconds(2), 0, 0}}};
  EXPECT_DOUBLE_EQ(LengthOf(dut), 9 + 4);
}

TEST(TrajectoryTest, PendulumSwingsBelowItsPivot) {
  const Trajectory dut = Pendulum{Pose::Translation(1, 2, 3), 2, 0.5, FromSeconds(4), At(0)};
  ExpectNear(PoseAt(dut, At(0)), Pose::Translation(1, 2, 1));
  const Pose out = PoseAt(dut, At(1));  // the angle is greatest: 0.5 rad about x
  EXPECT_LT(
      (out.translation - Eigen::Vector3d(1, 2 + 2 * std::sin(0.5), 3 - 2 * std::cos(0.5))).norm(),
      1e-12);
  ExpectNear(PoseAt(dut, At(4.7)), PoseAt(dut, At(0.7)), 1e-9);
}

}  // namespace
}  // namespace clearway
