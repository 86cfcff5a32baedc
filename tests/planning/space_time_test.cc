#include "clearway/planning/space_time.h"

#include <gtest/gtest.h>

#include "clearway/planning/space_time_problem.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
using std::chrono::seconds;

TEST(SpaceTime, Empty) {
  const auto dut = WithTime(MakeRn(2));
  EXPECT_EQ(dut->latest_s(), 20);
  EXPECT_FALSE(dut->isMetricSpace());
  EXPECT_FALSE(dut->hasSymmetricDistance());
  EXPECT_FALSE(dut->hasSymmetricInterpolate());
}

TEST(SpaceTime, TimeNeverRunsBackwards) {
  const auto dut = WithTime(MakeRn(2));
  const auto early = MakeState(dut, {0, 0, 1}), late = MakeState(dut, {0, 0, 2});
  EXPECT_TRUE(dut->CanReach(early.get(), late.get()));
  EXPECT_FALSE(dut->CanReach(late.get(), early.get()));
  EXPECT_DOUBLE_EQ(dut->distance(early.get(), late.get()), 0.5);
  EXPECT_EQ(dut->distance(late.get(), early.get()), dut->UnreachableDistance());
}

TEST(SpaceTime, WaitingAndStandingStillArePossible) {
  const auto dut = WithTime(MakeSe2());
  const auto a = MakeState(dut, {1, 2, 0.5, 3}), b = MakeState(dut, {1, 2, 0.5, 9});
  EXPECT_TRUE(dut->CanReach(a.get(), b.get()));
  EXPECT_TRUE(dut->CanReach(a.get(), a.get()));
  EXPECT_EQ(dut->distance(a.get(), a.get()), 0);
}

TEST(SpaceTime, TranslationLimit) {
  const auto dut = WithTime(MakeRn(3));
  const auto from = MakeState(dut, {0, 0, 0, 0});
  EXPECT_TRUE(dut->CanReach(from.get(), MakeState(dut, {0, 4, 0, 2.0001}).get()));
  EXPECT_FALSE(dut->CanReach(from.get(), MakeState(dut, {0, 4, 0, 1.999}).get()));
}

TEST(SpaceTime, RotationLimit) {
  const auto dut = WithTime(MakeSe2());
  const auto from = MakeState(dut, {0, 0, 3.0, 0});
  // By the shorter way: 2 pi - 6.0 = 0.2832 rad at 1 rad/s.
  EXPECT_TRUE(dut->CanReach(from.get(), MakeState(dut, {0, 0, -3.0, 0.284}).get()));
  EXPECT_FALSE(dut->CanReach(from.get(), MakeState(dut, {0, 0, -3.0, 0.283}).get()));
}

TEST(SpaceTime, RotationLimitInSe3IsOfTheAngleOfTurn) {
  const auto se3 = MakeSe3();
  const auto dut = WithTime(se3);
  ob::ScopedState<ob::SE3StateSpace> a(se3), b(se3);
  a->setXYZ(0, 0, 0);
  a->rotation().setIdentity();
  b->setXYZ(0, 0, 0);
  b->rotation().setAxisAngle(0, 1, 0, 1.5);
  EXPECT_NEAR(dut->MinSeconds(a.get(), b.get()), 1.5, 1e-9);
}

TEST(SpaceTime, PartsOfAPossibleMotionArePossible) {
  const auto dut = WithTime(MakeSe2());
  const auto sampler = dut->allocStateSampler();
  ob::ScopedState<> a(dut), b(dut), c(dut), d(dut);
  int possible = 0;
  for (int i = 0; i < 2000; ++i) {
    sampler->sampleUniform(a.get());
    sampler->sampleUniform(b.get());
    if (!dut->CanReach(a.get(), b.get())) continue;
    // The fastest motion, where rounding matters most.
    SpaceTimeStateSpace::SetSeconds(b.get(),
                                    SpaceTimeStateSpace::SecondsOf(a.get()) +
                                        dut->MinSeconds(SpaceTimeStateSpace::SpacePart(a.get()),
                                                        SpaceTimeStateSpace::SpacePart(b.get())));
    ++possible;
    dut->interpolate(a.get(), b.get(), 0.3, c.get());
    dut->interpolate(a.get(), b.get(), 0.7, d.get());
    EXPECT_TRUE(dut->CanReach(a.get(), c.get()));
    EXPECT_TRUE(dut->CanReach(c.get(), d.get()));
    EXPECT_TRUE(dut->CanReach(d.get(), b.get()));
  }
  EXPECT_GT(possible, 100);
}

// What stock planners do with an unreachable sample: a short step towards it.
TEST(SpaceTime, AStepTowardsTheUnreachableIsImpossibleToo) {
  const auto dut = WithTime(MakeSe2());
  const auto sampler = dut->allocStateSampler();
  ob::ScopedState<> a(dut), b(dut), c(dut);
  int impossible = 0;
  for (int i = 0; i < 2000; ++i) {
    sampler->sampleUniform(a.get());
    sampler->sampleUniform(b.get());
    const double distance = dut->distance(a.get(), b.get());
    if (distance < dut->UnreachableDistance()) continue;
    ++impossible;
    dut->interpolate(a.get(), b.get(), 0.2 * dut->getMaximumExtent() / distance, c.get());
    // A speed just above the limit may pass as rounding.
    const double speed_excess =
        dut->MinSeconds(SpaceTimeStateSpace::SpacePart(a.get()),
                        SpaceTimeStateSpace::SpacePart(b.get())) -
        (SpaceTimeStateSpace::SecondsOf(b.get()) - SpaceTimeStateSpace::SecondsOf(a.get()));
    if (speed_excess > 1e-3) {
      EXPECT_FALSE(dut->CanReach(a.get(), c.get()));
    }
  }
  EXPECT_GT(impossible, 100);
}

TEST(SpaceTime, OmplsSanityChecksPass) {
  const auto dut = WithTime(MakeSe2());
  dut->setup();
  EXPECT_NO_THROW(dut->sanityChecks());
}

TEST(SpaceTime, FocusedSamplesCanBeVisited) {
  const auto dut = WithTime(MakeRn(2));
  const auto start = MakeState(dut, {-5, 0, 1}), goal = MakeState(dut, {5, 0, 0});
  dut->Focus(start.get(), SpaceTimeStateSpace::SpacePart(goal.get()), 15);
  const auto sampler = dut->allocStateSampler();
  ob::ScopedState<> state(dut);
  for (int i = 0; i < 1000; ++i) {
    sampler->sampleUniform(state.get());
    EXPECT_TRUE(dut->CanReach(start.get(), state.get()));
    auto end = goal;
    SpaceTimeStateSpace::SetSeconds(end.get(), 15);
    EXPECT_TRUE(dut->CanReach(state.get(), end.get()));
  }
}

TEST(SpaceTime, SamplesNearAStateFollowIt) {
  const auto dut = WithTime(MakeSe2());
  const auto near = MakeState(dut, {1, 2, 0.5, 3});
  const auto sampler = dut->allocStateSampler();
  ob::ScopedState<> state(dut);
  for (int i = 0; i < 500; ++i) {
    sampler->sampleUniformNear(state.get(), near.get(), 2.0);
    EXPECT_TRUE(dut->CanReach(near.get(), state.get()));
    EXPECT_TRUE(dut->satisfiesBounds(state.get()));
    sampler->sampleGaussian(state.get(), near.get(), 0.5);
    EXPECT_TRUE(dut->CanReach(near.get(), state.get()));
    EXPECT_TRUE(dut->satisfiesBounds(state.get()));
  }
}

TEST(SpaceTime, ProjectionIsOfPlaceAndTime) {
  for (const ob::StateSpacePtr& part :
       {ob::StateSpacePtr(MakeRn(2)), ob::StateSpacePtr(MakeRn(3)), ob::StateSpacePtr(MakeSe2())}) {
    const auto dut = WithTime(part);
    dut->setup();
    auto state = MakeState(dut, {3, 4});
    SpaceTimeStateSpace::SetSeconds(state.get(), 5);
    Eigen::VectorXd projected(dut->getDefaultProjection()->getDimension());
    ASSERT_EQ(projected.size(), 3);
    dut->getDefaultProjection()->project(state.get(), projected);
    EXPECT_EQ(projected, Eigen::Vector3d(3, 4, 5));
  }
}

class GoalPoseBeforeTest : public ::testing::Test {
 protected:
  std::shared_ptr<SpaceTimeStateSpace> space_ = WithTime(MakeRn(2));
  ob::SpaceInformationPtr si_ = std::make_shared<ob::SpaceInformation>(space_);
  ob::ScopedState<> start_ = MakeState(space_, {0, -4, 1});
  ob::ScopedState<> goal_ = MakeState(space_, {0, 4, 0});
  const ob::State* goal_part_ = SpaceTimeStateSpace::SpacePart(goal_.get());
};

TEST_F(GoalPoseBeforeTest, SamplesArriveBetweenEarliestAndLatest) {
  const GoalPoseBefore dut(si_, start_.get(), goal_part_, {.tolerance = 0.1, .latest = seconds(9)});
  ob::ScopedState<> state(space_);
  double first = 100, last = 0;
  for (int i = 0; i < 500; ++i) {
    dut.sampleGoal(state.get());
    EXPECT_TRUE(dut.isSatisfied(state.get()));
    first = std::min(first, SpaceTimeStateSpace::SecondsOf(state.get()));
    last = std::max(last, SpaceTimeStateSpace::SecondsOf(state.get()));
  }
  EXPECT_GE(first, 5);  // 8 m at 2 m/s, from 1 s on
  EXPECT_LE(last, 9);
  EXPECT_LT(first, 5.2);
  EXPECT_GT(last, 8.8);
}

TEST_F(GoalPoseBeforeTest, AnyTimeBeforeLatestWithinToleranceIsArrival) {
  const GoalPoseBefore dut(si_, start_.get(), goal_part_, {.tolerance = 0.1, .latest = seconds(9)});
  EXPECT_TRUE(dut.isSatisfied(MakeState(space_, {0, 3.95, 7}).get()));
  EXPECT_FALSE(dut.isSatisfied(MakeState(space_, {0, 3.85, 7}).get()));
  EXPECT_FALSE(dut.isSatisfied(MakeState(space_, {0, 4, 9.1}).get()));
}

TEST_F(GoalPoseBeforeTest, ProblemRefusesWhatCannotBeReachedInTime) {
  EXPECT_TRUE(MakeSpaceTimeProblem(si_, start_.get(), goal_part_, {.latest = seconds(6)}).ok());
  const auto late = MakeSpaceTimeProblem(si_, start_.get(), goal_part_, {.latest = seconds(4)});
  EXPECT_EQ(late.status().code(), absl::StatusCode::kInvalidArgument);
  const auto outside = MakeState(space_, {0, 11, 0});
  EXPECT_FALSE(MakeSpaceTimeProblem(si_, outside.get(), goal_part_, {}).ok());
  EXPECT_FALSE(
      MakeSpaceTimeProblem(si_, start_.get(), SpaceTimeStateSpace::SpacePart(outside.get()), {})
          .ok());
  const auto no_time = std::make_shared<ob::SpaceInformation>(MakeRn(2));
  EXPECT_FALSE(MakeSpaceTimeProblem(no_time, start_.get(), goal_part_, {}).ok());
}

}  // namespace
}  // namespace clearway
