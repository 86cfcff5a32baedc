#include "clearway/planning/state_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planning/fixtures.h"

namespace clearway {
namespace {

using std::chrono::seconds;

const Time kNow = TimeFromNanoseconds(5'000'000'000);

StateBatch BatchOf(const StateMapping& dut, const ompl::base::ScopedState<>& state) {
  StateBatch batch;
  EXPECT_TRUE(dut.Append(state.get(), batch).ok());
  return batch;
}

TEST(StateMapping, Empty) {
  const auto dut = StateMapping::Se2(DeliveryRobot(), {}, FixedTime{kNow});
  EXPECT_FALSE(dut.has_time());
}

TEST(StateMapping, Se2StandsOnTheGroundWithItsLowestPoint) {
  const Ground slope{.height_m = [](double x_m, double y_m) { return 0.1 * x_m - 0.2 * y_m; },
                     .clearance_m = 0.15,
                     .max_slope = 0.25};
  const auto dut = StateMapping::Se2(DeliveryRobot(), slope, FixedTime{kNow});
  const StateBatch batch = BatchOf(dut, MakeState(MakeSe2(), {3, 1, kHalfTurn / 2}));
  ASSERT_EQ(batch.T_W_L.size(), 1u);
  EXPECT_EQ(batch.times[0], kNow);
  // The robot is 1 m high about its origin: ground 0.1, clearance 0.15, half its height 0.5.
  EXPECT_TRUE(batch.T_W_L[0].translation.isApprox(Eigen::Vector3d(3, 1, 0.75)));
  const Eigen::Vector3d ahead = batch.T_W_L[0] * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(3, 2, 0.75)));
}

TEST(StateMapping, LowestPointFollowsTheShapesPoses) {
  Robot robot = DeliveryRobot();
  robot.links[0].shapes[0].T_L_G = Pose::Translation(0, 0, 0.5);  // origin at the robot's foot
  const auto dut = StateMapping::R2(robot, {}, FixedTime{kNow});
  const StateBatch batch = BatchOf(dut, MakeState(MakeRn(2), {3, 1}));
  EXPECT_TRUE(batch.T_W_L[0].translation.isApprox(Eigen::Vector3d(3, 1, 0.15)));
  EXPECT_TRUE(batch.T_W_L[0].rotation.isApprox(Eigen::Quaterniond::Identity()));
}

TEST(StateMapping, R2KeepsItsYaw) {
  const auto dut = StateMapping::R2(DeliveryRobot(), {}, FixedTime{kNow}, kHalfTurn / 2);
  const StateBatch batch = BatchOf(dut, MakeState(MakeRn(2), {3, 1}));
  EXPECT_TRUE((batch.T_W_L[0] * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(3, 2, 0.65)));
}

TEST(StateMapping, R3AndSe3AreTheLinksPose) {
  const auto r3 = StateMapping::R3(DeliveryRobot(), FixedTime{kNow});
  EXPECT_TRUE(BatchOf(r3, MakeState(MakeRn(3), {3, 1, 2}))
                  .T_W_L[0]
                  .translation.isApprox(Eigen::Vector3d(3, 1, 2)));

  const auto se3 = StateMapping::Se3(DeliveryRobot(), FixedTime{kNow});
  ompl::base::ScopedState<ompl::base::SE3StateSpace> state(MakeSe3());
  state->setXYZ(3, 1, 2);
  state->rotation().setAxisAngle(0, 0, 1, kHalfTurn / 2);
  StateBatch batch;
  ASSERT_TRUE(se3.Append(state.get(), batch).ok());
  EXPECT_TRUE((batch.T_W_L[0] * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(3, 2, 2)));
}

TEST(StateMapping, EveryLinkOfARigidRobotTakesThePose) {
  Robot robot = DeliveryRobot();
  robot.links.push_back(robot.links[0]);
  const auto dut = StateMapping::R3(robot, FixedTime{kNow});
  const StateBatch batch = BatchOf(dut, MakeState(MakeRn(3), {3, 1, 2}));
  ASSERT_EQ(batch.T_W_L.size(), 2u);
  EXPECT_EQ(batch.T_W_L[0], batch.T_W_L[1]);
}

TEST(StateMapping, KinematicsOfAnArm) {
  Robot arm = DeliveryRobot();
  arm.links.push_back(arm.links[0]);
  // Two links of 1 m in the plane; a joint angle each.
  const auto kinematics = [](const ompl::base::State* state, std::span<Pose> T_W_L) {
    const auto& q = *state->as<ompl::base::RealVectorStateSpace::StateType>();
    const auto joint = [](double angle) {
      return Pose{Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d::Zero()};
    };
    T_W_L[0] = joint(q[0]);
    T_W_L[1] = T_W_L[0] * Pose::Translation(1, 0, 0) * joint(q[1]);
  };
  const auto dut = StateMapping::FromKinematics(arm, kinematics, TimeSince{kNow});
  const auto space = WithTime(MakeRn(2));
  const StateBatch batch = BatchOf(dut, MakeState(space, {kHalfTurn / 2, -kHalfTurn / 2, 1.5}));
  EXPECT_EQ(batch.times[0], kNow + std::chrono::milliseconds(1500));
  EXPECT_TRUE(
      (batch.T_W_L[1] * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 1, 0), 1e-12));
  const auto a = MakeState(space, {0, 0, 0});
  EXPECT_EQ(dut.MotionBoundMetres(a.get(), a.get()), std::nullopt);
}

TEST(StateMapping, TimeSinceAddsTheStatesSeconds) {
  const auto dut = StateMapping::R3(DeliveryRobot(), TimeSince{kNow});
  EXPECT_TRUE(dut.has_time());
  const StateBatch batch = BatchOf(dut, MakeState(WithTime(MakeRn(3)), {3, 1, 2, 0.25}));
  EXPECT_EQ(batch.times[0], kNow + std::chrono::milliseconds(250));
}

// The bound against the farthest that a corner of the robot really went, in many small steps.
void ExpectBoundHolds(const StateMapping& dut, const ompl::base::StateSpacePtr& space) {
  const auto sampler = space->allocStateSampler();
  ompl::base::ScopedState<> a(space), b(space), c(space);
  const Eigen::Vector3d corner(0.5, -0.35, 0.5);
  double total_length_m = 0, total_bound_m = 0;
  for (int i = 0; i < 200; ++i) {
    sampler->sampleUniform(a.get());
    sampler->sampleUniform(b.get());
    double length_m = 0;
    Eigen::Vector3d last = BatchOf(dut, a).T_W_L[0] * corner;
    for (int k = 1; k <= 200; ++k) {
      space->interpolate(a.get(), b.get(), k / 200.0, c.get());
      const Eigen::Vector3d p = BatchOf(dut, c).T_W_L[0] * corner;
      length_m += (p - last).norm();
      last = p;
    }
    const double bound_m = dut.MotionBoundMetres(a.get(), b.get()).value();
    EXPECT_LE(length_m, bound_m + 1e-9);
    total_length_m += length_m;
    total_bound_m += bound_m;
  }
  EXPECT_GE(total_length_m, 0.6 * total_bound_m);  // and it is no wild guess
}

TEST(StateMapping, BoundHoldsForEveryRigidSpace) {
  const Robot robot = DeliveryRobot();
  ExpectBoundHolds(StateMapping::Se2(robot, {}, FixedTime{kNow}), MakeSe2());
  ExpectBoundHolds(StateMapping::Se3(robot, FixedTime{kNow}), MakeSe3());
  ExpectBoundHolds(StateMapping::R2(robot, {}, FixedTime{kNow}), MakeRn(2));
  ExpectBoundHolds(StateMapping::R3(robot, FixedTime{kNow}), MakeRn(3));
  ExpectBoundHolds(StateMapping::Se2(robot, {}, TimeSince{kNow}), WithTime(MakeSe2()));
}

TEST(StateMapping, RefusesOtherSpaces) {
  const Robot robot = DeliveryRobot();
  const auto se2 = StateMapping::Se2(robot, {}, FixedTime{kNow});
  EXPECT_TRUE(se2.ValidateSpace(*MakeSe2(), robot).ok());
  EXPECT_FALSE(se2.ValidateSpace(*MakeSe3(), robot).ok());
  EXPECT_FALSE(se2.ValidateSpace(*WithTime(MakeSe2()), robot).ok());
  const auto r3 = StateMapping::R3(robot, TimeSince{kNow});
  EXPECT_TRUE(r3.ValidateSpace(*WithTime(MakeRn(3)), robot).ok());
  EXPECT_FALSE(r3.ValidateSpace(*MakeRn(3), robot).ok());
  EXPECT_FALSE(r3.ValidateSpace(*WithTime(MakeRn(2)), robot).ok());
}

TEST(StateMapping, RefusesARobotOfOtherLinks) {
  Robot two = DeliveryRobot();
  two.links.push_back(two.links[0]);
  const auto dut = StateMapping::Se2(DeliveryRobot(), {}, FixedTime{kNow});
  const absl::Status status = dut.ValidateSpace(*MakeSe2(), two);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
}

TEST(StateMapping, HeightsNeedASlope) {
  Ground ground{.height_m = [](double x_m, double) { return 0.1 * x_m; }};
  const auto status = [&] {
    return StateMapping::R2(DeliveryRobot(), ground, FixedTime{kNow})
        .ValidateSpace(*MakeRn(2), DeliveryRobot());
  };
  for (const std::optional<double> bad : {std::optional<double>(), {-0.1}, {std::nan("")}}) {
    ground.max_slope = bad;
    EXPECT_EQ(status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_NE(status().message().find("ground.max_slope"), std::string::npos);
  }
  ground.max_slope = 0.1;
  EXPECT_TRUE(status().ok()) << status();
}

TEST(StateMapping, RefusesPosesThatAreNotFinite) {
  const auto space = MakeSe2();
  const Ground hole{.height_m = [](double x_m, double) { return x_m > 1 ? std::nan("") : 0.0; },
                    .max_slope = 0};
  const auto dut = StateMapping::Se2(DeliveryRobot(), hole, FixedTime{kNow});
  for (const auto& bad : {MakeState(space, {2, 0, 0}), MakeState(space, {0, std::nan(""), 0})}) {
    StateBatch batch;
    EXPECT_EQ(dut.Append(bad.get(), batch).code(), absl::StatusCode::kInvalidArgument);
    EXPECT_TRUE(batch.times.empty());
    EXPECT_TRUE(batch.T_W_L.empty());
  }
}

TEST(StateMapping, RefusesTimesThatAreNotFinite) {
  const auto dut = StateMapping::R3(DeliveryRobot(), TimeSince{kNow});
  for (double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e18}) {
    const auto state = MakeState(WithTime(MakeRn(3)), {3, 1, 2, bad});
    StateBatch batch;
    EXPECT_EQ(dut.Append(state.get(), batch).code(), absl::StatusCode::kInvalidArgument);
    EXPECT_TRUE(batch.times.empty());
    EXPECT_TRUE(batch.T_W_L.empty());
  }
}

}  // namespace
}  // namespace clearway
