#include "clearway/planning/state_query.h"

#include <gtest/gtest.h>

#include <cmath>

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
  const Robot& robot() const override { return robot_; }
  std::uint64_t version() const override { return 7; }
  Time stamp() const override { return Time(); }

  mutable StateBatch batch;
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
  EXPECT_TRUE(poses.back().translation.isApprox(Eigen::Vector3d(1, 2, 0.6)));
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
