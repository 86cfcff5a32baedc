// What MakeSpaceTimeSetup refuses, so that nothing of it reaches OMPL, and what it must not refuse.
#include "clearway/planning/space_time_setup.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "planning/road_crossing.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// 8 m along x on an empty plane.
struct Problem {
  double low = -5, high = 5;
  SpeedLimits limits{.translation_mps = 1, .rotation_radps = 1};
  Duration latest = std::chrono::seconds(60);
  std::vector<double> start{-4, 0, 0}, goal{4, 0, 0};
  GoalOptions options;
  Time origin;
  std::vector<MovingDisc> discs;

  absl::StatusOr<ompl::geometric::SimpleSetupPtr> Setup() const {
    auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
    plane->setBounds(-5, 5);
    const auto space = std::make_shared<SpaceTimeStateSpace>(plane, limits, latest);
    const auto from = MakeState(space, start), to = MakeState(space, goal);
    ob::RealVectorBounds bounds(2);
    bounds.low.assign(2, low);
    bounds.high.assign(2, high);
    const_cast<ob::RealVectorBounds&>(plane->getBounds()) = bounds;  // OMPL's setter throws
    return MakeSpaceTimeSetup(space, std::make_shared<DiscChecker>(DeliveryRobot(), discs),
                              StateMapping::R2(DeliveryRobot(), {}, TimeSince{origin}), {},
                              from.get(), SpaceTimeStateSpace::SpacePart(to.get()), options);
  }
};

// What the problem that `change` makes is refused for.
std::string Refusal(const std::function<void(Problem&)>& change) {
  Problem dut;
  change(dut);
  const auto setup = dut.Setup();
  EXPECT_EQ(setup.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(setup.status().message());
}

TEST(SpaceTimeSetup, RefusesLimitsOfOtherAxesAndLatestTimesWithoutEnd) {
  for (const std::vector<double>& bad : {std::vector<double>{1}, {1, 1, 1}}) {
    EXPECT_THAT(Refusal([=](Problem& p) { p.limits.axes_per_s = bad; }),
                HasSubstr("limits.axes_per_s: has"));
  }
  EXPECT_THAT(Refusal([](Problem& p) { p.latest = Duration::max(); }), HasSubstr("latest"));
}

TEST(SpaceTimeSetup, RefusesALatestTimeThatIsNotAboveZero) {
  for (const int bad_s : {0, -1}) {
    EXPECT_THAT(Refusal([=](Problem& p) { p.latest = std::chrono::seconds(bad_s); }),
                HasSubstr("latest"));
  }
}

TEST(SpaceTimeSetup, RefusesSpeedsThatAreNotAboveZero) {
  for (const double bad : {0.0, -1.0, kNan}) {
    EXPECT_THAT(Refusal([=](Problem& p) { p.limits.translation_mps = bad; }),
                HasSubstr("limits.translation_mps"));
    EXPECT_THAT(Refusal([=](Problem& p) { p.limits.rotation_radps = bad; }),
                HasSubstr("limits.rotation_radps"));
    EXPECT_THAT(Refusal([=](Problem& p) {
                  p.limits.axes_per_s = std::vector<double>{1, bad};
                }),
                HasSubstr("limits.axes_per_s[1]"));
  }
}

TEST(SpaceTimeSetup, RefusesBoundsThatAreNone) {
  const auto refused = [](double low, double high) {
    return Refusal([=](Problem& p) { p.low = low, p.high = high; });
  };
  EXPECT_THAT(refused(kNan, 5), HasSubstr("bounds[0]"));
  EXPECT_THAT(refused(-5, kInfinity), HasSubstr("bounds[0]"));
  EXPECT_THAT(refused(-1e308, 1e308), HasSubstr("bounds[0]"));
  EXPECT_THAT(refused(5, -5), HasSubstr("must ascend"));
}

TEST(SpaceTimeSetup, RefusesEndsThatAreNoPlaces) {
  EXPECT_THAT(Refusal([](Problem& p) { p.start[0] = kNan; }), HasSubstr("start"));
  EXPECT_THAT(Refusal([](Problem& p) { p.goal[1] = kInfinity; }), HasSubstr("goal_part"));
  EXPECT_THAT(Refusal([](Problem& p) { p.goal[0] = 6; }), HasSubstr("goal_part"));
}

TEST(SpaceTimeSetup, RefusesEndsThatAreNull) {
  const Crossing crossing({});
  const ob::State* const goal = SpaceTimeStateSpace::SpacePart(crossing.goal.get());
  const auto refusal = [&](const ob::State* start, const ob::State* goal_part) {
    const auto mapping = StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()});
    const auto dut =
        MakeSpaceTimeSetup(crossing.space, crossing.checker, mapping, {}, start, goal_part, {});
    return std::string(dut.status().message());
  };
  EXPECT_EQ(refusal(nullptr, goal), "start: is null");
  EXPECT_EQ(refusal(crossing.start.get(), nullptr), "goal_part: is null");
}

TEST(SpaceTimeSetup, RefusesTolerancesThatNothingMeets) {
  for (const double bad : {0.0, -1.0, kNan}) {
    EXPECT_THAT(Refusal([=](Problem& p) { p.options.tolerance = bad; }), HasSubstr("tolerance"));
  }
}

TEST(SpaceTimeSetup, RefusesArrivalsBeforeTheEarliest) {
  EXPECT_THAT(Refusal([](Problem& p) { p.latest = std::chrono::milliseconds(7999); }),
              HasSubstr("reached at full speed"));
}

TEST(SpaceTimeSetup, RefusesAStartInTheScenesPast) {
  EXPECT_THAT(Refusal([](Problem& p) { p.origin = Time() - std::chrono::nanoseconds(1); }),
              HasSubstr("start: is at -1 ns, in the past of the scene, which is of 0"));
}

// Of the problem, whatever the space allows.
TEST(SpaceTimeSetup, SaysThatTheLatestArrivalLeavesNoWayRound) {
  Problem problem;
  problem.discs = {{{0, 0}, {0, 0}, 1}};
  problem.options.latest = std::chrono::seconds(8);
  const auto dut = problem.Setup();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ((*dut)->solve(60.0), ob::PlannerStatus::ABORT);
  problem.options.latest = std::chrono::seconds(9);
  EXPECT_EQ((*problem.Setup())->solve(0.3), ob::PlannerStatus::EXACT_SOLUTION);
}

TEST(SpaceTimeSetup, AnArrivalAtTheVeryLatestIsOne) {
  Problem problem;
  problem.latest = std::chrono::seconds(8);
  const auto dut = problem.Setup();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ((*dut)->solve(1.0), ob::PlannerStatus::EXACT_SOLUTION);
}

}  // namespace
}  // namespace clearway
