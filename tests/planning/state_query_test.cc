#include "clearway/planning/state_query.h"

#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <cmath>

#include "collision/link_motion.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;

// Keeps the last batch; everything is free.
class RecordingChecker : public StateChecker {
 public:
  absl::StatusOr<CheckReply> Check(const StateBatch& states, const CheckOptions&) const override {
    batch = states;
    ++calls;
    StateAnswer free;
    free.status = SpaceStatus::kFree;
    return CheckReply{answer_version, Time(),
                      std::vector<StateAnswer>(states.times.size() - missing_answers, free)};
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions&) const override {
    motion = motions;
    ++calls;
    MotionAnswer free;
    free.status = SpaceStatus::kFree;
    return MotionReply{answer_version,
                       Time(),
                       {},
                       0,
                       0,
                       std::vector<MotionAnswer>(motions.knot_counts.size(), free)};
  }
  const Robot& robot() const override { return robot_; }
  std::uint64_t version() const override { return 7; }
  Time stamp() const override { return Time(); }

  mutable StateBatch batch;
  mutable MotionBatch motion;
  mutable int calls = 0;
  std::uint64_t answer_version = 7;
  std::size_t missing_answers = 0;

 private:
  Robot robot_ = DeliveryRobot();
};

class StateQueryTest : public ::testing::Test {
 protected:
  StateQuery Query(ompl::base::StateSpacePtr space, StateMapping mapping,
                   PlanningOptions options = {}) {
    return StateQuery(std::move(space), checker_, std::move(mapping), std::move(options));
  }
  std::shared_ptr<RecordingChecker> checker_ = std::make_shared<RecordingChecker>();
};

TEST_F(StateQueryTest, Empty) {
  const auto dut = Query(MakeSe2(), StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}));
  EXPECT_EQ(dut.error_count(), 0);
  EXPECT_TRUE(dut.first_error().ok());
}

TEST_F(StateQueryTest, OneCallForAWholeMotion) {
  const auto space = MakeSe2();
  const auto dut = Query(space, StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}));
  const auto a = MakeState(space, {-8, 0, 0}), b = MakeState(space, {8, 3, 2});
  const auto answers = dut.CheckMotion(a.get(), b.get());
  EXPECT_EQ(checker_->calls, 1);
  EXPECT_EQ(answers.size(), checker_->batch.times.size());
}

TEST_F(StateQueryTest, NoPointMovesFurtherThanTheStep) {
  const auto space = MakeSe2();
  const auto dut = Query(space, StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}));
  const auto a = MakeState(space, {0, 0, -1}), b = MakeState(space, {1, 2, 2});
  dut.CheckMotion(a.get(), b.get());
  const Eigen::Vector3d corner(0.5, 0.35, 0.5);
  const auto& poses = checker_->batch.T_W_L;
  ASSERT_GT(poses.size(), 50u);
  double longest_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    longest_m = std::max(longest_m, (poses[i] * corner - poses[i - 1] * corner).norm());
  }
  EXPECT_LE(longest_m, 0.05);
  EXPECT_GT(longest_m, 0.03);  // without waste
  EXPECT_TRUE(poses.back().translation.isApprox(Eigen::Vector3d(1, 2, 0.65)));
}

TEST_F(StateQueryTest, WaitingIsCheckedInTime) {
  const auto space = WithTime(MakeRn(2));
  PlanningOptions options;
  options.time_step = milliseconds(100);
  const auto dut = Query(space, StateMapping::R2(DeliveryRobot(), {}, TimeSince{Time()}), options);
  const auto a = MakeState(space, {1, 1, 2}), b = MakeState(space, {1, 1, 5});
  std::vector<Time> times;
  EXPECT_EQ(dut.CheckMotion(a.get(), b.get(), &times).size(), 30u);
  EXPECT_EQ(times.front(), TimeFromNanoseconds(2'100'000'000));
  EXPECT_EQ(times.back(), TimeFromNanoseconds(5'000'000'000));
}

TEST_F(StateQueryTest, WithoutABoundTheSpacesSegmentsCount) {
  const auto space = MakeRn(3);
  space->setLongestValidSegmentFraction(0.01);
  space->setup();
  const auto kinematics = [](const ompl::base::State*, std::span<Pose>) {};
  const auto dut =
      Query(space, StateMapping::FromKinematics(DeliveryRobot(), kinematics, FixedTime{Time()}));
  const auto a = MakeState(space, {0, 0, 0}), b = MakeState(space, {3, 0, 0});
  EXPECT_EQ(dut.CheckMotion(a.get(), b.get()).size(), space->validSegmentCount(a.get(), b.get()));
}

TEST_F(StateQueryTest, StatesOutsideTheBoundsAreNotAskedFor) {
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  EXPECT_EQ(dut.CheckState(MakeState(space, {11, 0, 0}).get()).status, SpaceStatus::kOutOfBounds);
  EXPECT_EQ(checker_->calls, 0);
}

TEST_F(StateQueryTest, AMotionOutOfTheBoundsIsFreeUpToThem) {
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  const auto a = MakeState(space, {9, 0, 0}), b = MakeState(space, {11, 0, 0});
  const auto answers = dut.CheckMotion(a.get(), b.get());
  ASSERT_EQ(answers.size(), 40u);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].status, i < 20 ? SpaceStatus::kFree : SpaceStatus::kOutOfBounds) << i;
  }
}

TEST_F(StateQueryTest, ImpossibleMotionsAreUnresolvedButNoError) {
  const auto space = WithTime(MakeRn(2));
  const auto dut = Query(space, StateMapping::R2(DeliveryRobot(), {}, TimeSince{Time()}));
  const auto a = MakeState(space, {1, 1, 2}), b = MakeState(space, {1, 1, 1});
  const auto answers = dut.CheckMotion(a.get(), b.get());
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].status, SpaceStatus::kUnresolved);
  EXPECT_EQ(checker_->calls, 0);
  EXPECT_EQ(dut.error_count(), 0);
}

TEST_F(StateQueryTest, MotionsOfTooManyStatesAreRefused) {
  const auto space = MakeRn(3);
  PlanningOptions options;
  options.max_states_per_motion = 100;
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}), options);
  const auto a = MakeState(space, {-9, 0, 0}), b = MakeState(space, {9, 0, 0});
  EXPECT_EQ(dut.CheckMotion(a.get(), b.get())[0].status, SpaceStatus::kUnresolved);
  EXPECT_EQ(dut.first_error().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(checker_->calls, 0);
}

TEST_F(StateQueryTest, StatesThatAreNotNumbersAreRefused) {
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  const auto a = MakeState(space, {-9, 0, 0}), b = MakeState(space, {std::nan(""), 0, 0});
  EXPECT_NE(dut.CheckMotion(a.get(), b.get())[0].status, SpaceStatus::kFree);
  EXPECT_NE(dut.CheckState(b.get()).status, SpaceStatus::kFree);
}

TEST_F(StateQueryTest, AnAnswerOnAnotherVersionIsAnError) {
  checker_->answer_version = 8;
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  EXPECT_EQ(dut.CheckState(MakeState(space, {0, 0, 0}).get()).status, SpaceStatus::kUnresolved);
  EXPECT_EQ(dut.error_count(), 1);
}

TEST_F(StateQueryTest, AReplyOfAnotherLengthIsAnError) {
  checker_->missing_answers = 1;
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  const auto a = MakeState(space, {0, 0, 0}), b = MakeState(space, {1, 0, 0});
  for (const StateAnswer& answer : dut.CheckMotion(a.get(), b.get())) {
    EXPECT_EQ(answer.status, SpaceStatus::kUnresolved);
  }
  EXPECT_EQ(dut.error_count(), 1);
}

// At each moment of a motion that is put to the checker, against the space's interpolation.
void ExpectWithinDeviations(const StateQuery& query, const MotionBatch& motion,
                            const ompl::base::ScopedState<>& a,
                            const ompl::base::ScopedState<>& b) {
  ompl::base::ScopedState<> state(a);
  const std::size_t legs = motion.T_W_L.size() - 1;
  for (std::size_t i = 0; i <= 10 * legs; ++i) {
    const double at = static_cast<double>(i) / 10;
    const auto leg = std::min(static_cast<std::size_t>(at), legs - 1);
    query.space().interpolate(a.get(), b.get(), at / static_cast<double>(legs), state.get());
    StateBatch truth;
    ASSERT_TRUE(query.mapping().Append(state.get(), truth).ok());
    const Pose told =
        LinkMotion(motion.T_W_L[leg], motion.T_W_L[leg + 1], 1).At(at - static_cast<double>(leg));
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d p_L(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.35 : -0.35,
                                corner & 4 ? 0.5 : -0.5);
      ASSERT_LE((told * p_L - truth.T_W_L[0] * p_L).norm(), motion.deviations_m[leg] + 1e-9);
    }
  }
}

// A crank of 1.5 m with the robot turning at its end.
void PlaceOnCrank(const ompl::base::State* state, std::span<Pose> T_W_L) {
  const auto& q = *state->as<ompl::base::RealVectorStateSpace::StateType>();
  const Eigen::AngleAxisd crank(q[0], Eigen::Vector3d::UnitZ()),
      end(q[1], Eigen::Vector3d::UnitY());
  T_W_L[0] = {Eigen::Quaterniond(crank * end), crank * Eigen::Vector3d(1.5, 0, 0)};
}

TEST_F(StateQueryTest, LinksStayWithinTheDeviationsThatTheCheckerIsTold) {
  const double reach_m = Eigen::Vector3d(0.5, 0.35, 0.5).norm();
  const auto bound = [&](const ompl::base::State* from, const ompl::base::State* to) {
    const auto& a = *from->as<ompl::base::RealVectorStateSpace::StateType>();
    const auto& b = *to->as<ompl::base::RealVectorStateSpace::StateType>();
    return std::abs(a[0] - b[0]) * (1.5 + reach_m) + std::abs(a[1] - b[1]) * reach_m;
  };
  const Ground waves{.height_m = [](double x, double y) { return 0.3 * std::sin(x + 2 * y); },
                     .max_slope = 0.3 * std::sqrt(5)};
  const FixedTime now{Time()};
  const Robot robot = DeliveryRobot();
  const std::vector<std::pair<ompl::base::StateSpacePtr, StateMapping>> cases = {
      {MakeSe2(), StateMapping::Se2(robot, {}, now)},
      {MakeSe2(), StateMapping::Se2(robot, waves, now)},
      {MakeRn(2), StateMapping::R2(robot, waves, now)},
      {MakeRn(3), StateMapping::R3(robot, now)},
      {MakeRn(2), StateMapping::FromKinematics(robot, PlaceOnCrank, now, bound)}};
  for (const auto& [space, mapping] : cases) {
    const auto dut = Query(space, mapping);
    const auto sampler = space->allocStateSampler();
    ompl::base::ScopedState<> a(space), b(space);
    for (int i = 0; i < 30; ++i) {
      sampler->sampleUniform(a.get());
      sampler->sampleUniform(b.get());
      EXPECT_TRUE(dut.ProveMotion(a.get(), b.get()).free());
      ExpectWithinDeviations(dut, checker_->motion, a, b);
    }
  }
}

TEST_F(StateQueryTest, HalfATurnGoesTheWayOfTheSpace) {
  const auto space = MakeSe2();
  const auto dut = Query(space, StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}));
  for (const double yaw_rad : {-kHalfTurn, kHalfTurn - 1e-9, 3.1}) {
    const auto a = MakeState(space, {0, 0, 0}), b = MakeState(space, {0, 0, yaw_rad});
    EXPECT_TRUE(dut.ProveMotion(a.get(), b.get()).free());
    EXPECT_EQ(checker_->motion.knot_counts, std::vector<std::size_t>{3});
    ExpectWithinDeviations(dut, checker_->motion, a, b);
  }
}

TEST_F(StateQueryTest, ProofsOfAnotherVersionAreErrors) {
  checker_->answer_version = 8;
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  const auto a = MakeState(space, {0, 0, 0}), b = MakeState(space, {1, 0, 0});
  EXPECT_FALSE(dut.ProveMotion(a.get(), b.get()).free());
  EXPECT_EQ(dut.ProveMotion(a.get(), b.get()).free_fraction, 0);
  EXPECT_EQ(dut.error_count(), 2);
}

TEST_F(StateQueryTest, WhatIsNoNumberIsNotProvedFree) {
  const auto space = MakeRn(3);
  const auto dut = Query(space, StateMapping::R3(DeliveryRobot(), FixedTime{Time()}));
  const auto a = MakeState(space, {-9, 0, 0}), b = MakeState(space, {std::nan(""), 0, 0});
  EXPECT_FALSE(dut.ProveMotion(a.get(), b.get()).free());
}

TEST_F(StateQueryTest, OptionsThatMakeNoSenseAreRefused) {
  const Robot robot = DeliveryRobot();
  EXPECT_TRUE(Validate(PlanningOptions(), robot).ok());
  PlanningOptions step, time_step, count, clearance;
  step.step_m = 0;
  time_step.time_step = Duration(0);
  count.max_states_per_motion = 0;
  clearance.clearance_up_to_m = std::nan("");
  for (const PlanningOptions& dut : {step, time_step, count, clearance}) {
    EXPECT_EQ(Validate(dut, robot).code(), absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace
}  // namespace clearway
