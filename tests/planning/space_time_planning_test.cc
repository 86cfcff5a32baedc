// Stock planners of OMPL past moving vehicles, their plans verified against the analytic world.
#include <gtest/gtest.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include "clearway/planning/earliest_arrival.h"
#include "clearway/planning/path_check.h"
#include "clearway/planning/space_information.h"
#include "clearway/planning/space_time_problem.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using std::chrono::seconds;

// The fastest object moves 7 m/s * 25 ms between two checked states: with half of that as padding,
// a plan is free at every instant.
constexpr double kPaddingMetres = 0.0875;

// A vehicle of 5 m x 2 m along x, of discs.
void AddVehicle(double x_m, double y_m, double speed_mps, std::vector<MovingDisc>& discs) {
  for (double offset_m : {-1.5, -0.5, 0.5, 1.5}) {
    discs.push_back({{x_m + offset_m, y_m}, {speed_mps, 0}, 1.0});
  }
}

// One vehicle, at the robot's straight way when the robot would be.
std::vector<MovingDisc> OneVehicle() {
  std::vector<MovingDisc> discs;
  AddVehicle(-14, 0, 7, discs);
  return discs;
}

// Traffic on two lanes.
std::vector<MovingDisc> TwoLanes() {
  std::vector<MovingDisc> discs = OneVehicle();
  for (int i = 0; i < 5; ++i) {
    AddVehicle(-40 - 26 * i, 0, 7, discs);
    AddVehicle(12 + 22 * i, 2.2, -5, discs);
  }
  return discs;
}

// From 4 m on one side of the road to 4 m on the other, in SE(2) and time, at most 2 m/s.
struct Crossing {
  explicit Crossing(std::vector<MovingDisc> discs)
      : checker(std::make_shared<DiscChecker>(DeliveryRobot(), std::move(discs))) {
    space = std::make_shared<SpaceTimeStateSpace>(MakeSe2(5), SpeedLimits{2.0, 1.5}, seconds(12));
    PlanningOptions options;
    options.check.padding_m = kPaddingMetres;
    si = MakeSpaceInformation(space, checker,
                              StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()}), options)
             .value();
    start = MakeState(space, {0, -4, kHalfTurn / 2, 0});
    goal = MakeState(space, {0, 4, kHalfTurn / 2, 0});
    problem = MakeSpaceTimeProblem(si, start.get(), SpaceTimeStateSpace::SpacePart(goal.get()),
                                   {.tolerance = 0.1})
                  .value();
  }

  // Whether `planner` solves the problem exactly within so many iterations (RRT* uses them all).
  bool Solve(ob::Planner& planner, unsigned int iterations) {
    planner.setProblemDefinition(problem);
    planner.setup();
    ob::IterationTerminationCondition limit(iterations);
    const ob::PlannerTerminationCondition until(
        [&] { return limit.eval() || problem->hasExactSolution(); });
    planner.solve(until);
    return problem->hasExactSolution();
  }
  const og::PathGeometric& Path() const {
    return *problem->getSolutionPath()->as<og::PathGeometric>();
  }

  std::shared_ptr<DiscChecker> checker;
  std::shared_ptr<SpaceTimeStateSpace> space;
  ob::SpaceInformationPtr si;
  ob::ScopedState<> start{MakeSe2()}, goal{MakeSe2()};
  ob::ProblemDefinitionPtr problem;
};

// Every 5 ms, from the definition of the space and the world alone.
void ExpectFreeInTheWorld(const Crossing& crossing) {
  const og::PathGeometric& path = crossing.Path();
  const auto& mapping = QueryOf(*crossing.si)->mapping();
  ob::ScopedState<> state(crossing.space);
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    const ob::State *a = path.getState(i - 1), *b = path.getState(i);
    const double a_s = SpaceTimeStateSpace::SecondsOf(a), b_s = SpaceTimeStateSpace::SecondsOf(b);
    ASSERT_GE(b_s, a_s);
    const auto* pa = SpaceTimeStateSpace::SpacePart(a)->as<ob::SE2StateSpace::StateType>();
    const auto* pb = SpaceTimeStateSpace::SpacePart(b)->as<ob::SE2StateSpace::StateType>();
    const double length_m = std::hypot(pb->getX() - pa->getX(), pb->getY() - pa->getY());
    EXPECT_LE(length_m, 2.0 * (b_s - a_s) + 1e-5);
    const int n = static_cast<int>(std::ceil((b_s - a_s) / 0.005));
    for (int k = 0; k <= n; ++k) {
      crossing.space->interpolate(a, b, n == 0 ? 0 : static_cast<double>(k) / n, state.get());
      StateBatch batch;
      ASSERT_TRUE(mapping.Append(state.get(), batch).ok());
      ASSERT_GT(crossing.checker->Distance(batch.times[0], batch.T_W_L.data()), 0);
    }
  }
  const ob::State* end = path.getState(path.getStateCount() - 1);
  EXPECT_LE(SpaceTimeStateSpace::SecondsOf(end), 12);
  EXPECT_TRUE(crossing.problem->getGoal()->isSatisfied(end));
}

template <class Planner>
int SolvedRuns(int runs, const std::vector<MovingDisc>& discs, unsigned int iterations) {
  int solved = 0;
  for (int run = 0; run < runs; ++run) {
    Crossing crossing(discs);
    Planner planner(crossing.si);
    if (!crossing.Solve(planner, iterations)) continue;
    ++solved;
    EXPECT_TRUE(CheckPath(crossing.Path(), *QueryOf(*crossing.si)).free);
    ExpectFreeInTheWorld(crossing);
  }
  return solved;
}

TEST(SpaceTimePlanning, EmptyRoadIsCrossed) {
  Crossing crossing({});
  og::RRT planner(crossing.si);
  EXPECT_TRUE(crossing.Solve(planner, 1000));
  ExpectFreeInTheWorld(crossing);
}

TEST(SpaceTimePlanning, StraightAheadMeetsTheVehicle) {
  Crossing crossing(OneVehicle());
  auto end = crossing.goal;
  SpaceTimeStateSpace::SetSeconds(end.get(), 4);
  EXPECT_FALSE(crossing.si->checkMotion(crossing.start.get(), end.get()));
}

TEST(SpaceTimePlanning, RrtPastOneVehicle) {
  EXPECT_GE(SolvedRuns<og::RRT>(24, OneVehicle(), 5000), 23);
}
TEST(SpaceTimePlanning, KpiecePastOneVehicle) {
  EXPECT_GE(SolvedRuns<og::KPIECE1>(24, OneVehicle(), 5000), 23);
}
TEST(SpaceTimePlanning, EstPastOneVehicle) {
  EXPECT_GE(SolvedRuns<og::EST>(24, OneVehicle(), 5000), 23);
}
TEST(SpaceTimePlanning, RrtStarPastOneVehicle) {
  EXPECT_GE(SolvedRuns<og::RRTstar>(10, OneVehicle(), 300), 9);
}

TEST(SpaceTimePlanning, RrtThroughTwoLanes) {
  EXPECT_GE(SolvedRuns<og::RRT>(8, TwoLanes(), 20000), 7);
}
TEST(SpaceTimePlanning, RoundsArriveEarlierAndEarlier) {
  Crossing crossing(OneVehicle());
  const ob::State* goal_part = SpaceTimeStateSpace::SpacePart(crossing.goal.get());
  ob::IterationTerminationCondition limit(3000);
  const auto path = PlanEarliestArrival(std::make_shared<og::RRT>(crossing.si),
                                        crossing.start.get(), goal_part, {}, limit);
  ASSERT_TRUE(path.ok()) << path.status();
  EXPECT_TRUE(CheckPath(**path, *QueryOf(*crossing.si)).free);
  const ob::State* end = (*path)->getState((*path)->getStateCount() - 1);
  EXPECT_GE(SpaceTimeStateSpace::SecondsOf(end), 4 - 0.1);
  EXPECT_LE(SpaceTimeStateSpace::SecondsOf(end), 6.5);
}

TEST(SpaceTimePlanning, RoundsWithoutAPathSayWhy) {
  Crossing crossing({});
  const auto si =
      MakeSpaceInformation(crossing.space,
                           std::make_shared<FailingChecker>(absl::UnavailableError("server gone")),
                           StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()}), {})
          .value();
  ob::IterationTerminationCondition limit(100);
  const auto path =
      PlanEarliestArrival(std::make_shared<og::RRT>(si), crossing.start.get(),
                          SpaceTimeStateSpace::SpacePart(crossing.goal.get()), {}, limit);
  EXPECT_EQ(path.status().code(), absl::StatusCode::kNotFound);
  EXPECT_NE(path.status().message().find("server gone"), std::string::npos);
}

TEST(SpaceTimePlanning, AWallOfVehiclesHasNoPlan) {
  std::vector<MovingDisc> discs;
  for (int i = 0; i < 40; ++i) AddVehicle(-5.0 * i + 10, 0, 7, discs);
  Crossing crossing(discs);
  og::RRT planner(crossing.si);
  EXPECT_FALSE(crossing.Solve(planner, 2000));
}

TEST(SpaceTimePlanning, AFailingCheckerHasNoPlan) {
  Crossing crossing({});
  crossing.si =
      MakeSpaceInformation(crossing.space,
                           std::make_shared<FailingChecker>(absl::UnavailableError("server gone")),
                           StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()}), {})
          .value();
  crossing.problem = MakeSpaceTimeProblem(crossing.si, crossing.start.get(),
                                          SpaceTimeStateSpace::SpacePart(crossing.goal.get()), {})
                         .value();
  og::RRT planner(crossing.si);
  EXPECT_FALSE(crossing.Solve(planner, 100));
  EXPECT_GT(QueryOf(*crossing.si)->error_count(), 0);
  EXPECT_EQ(QueryOf(*crossing.si)->first_error(), absl::UnavailableError("server gone"));
}

// Without time, in a static world, the space is symmetric and two trees may meet.
TEST(StaticPlanning, RrtConnectAroundADisc) {
  const auto space = MakeSe2(5);
  const auto checker = std::make_shared<DiscChecker>(
      DeliveryRobot(), std::vector<MovingDisc>{{{0, 0}, {0, 0}, 2.0}});
  const auto si = MakeSpaceInformation(
                      space, checker, StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}), {})
                      .value();
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(MakeState(space, {0, -4, 0}), MakeState(space, {0, 4, 0}));
  og::RRTConnect planner(si);
  planner.setProblemDefinition(problem);
  planner.setup();
  ob::IterationTerminationCondition limit(10000);
  EXPECT_EQ(planner.solve(limit), ob::PlannerStatus::EXACT_SOLUTION);
  const auto& path = *problem->getSolutionPath()->as<og::PathGeometric>();
  EXPECT_TRUE(CheckPath(path, *QueryOf(*si)).free);
}

}  // namespace
}  // namespace clearway
