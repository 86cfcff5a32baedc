// Stock planners of OMPL past moving vehicles, their plans verified against the analytic world.
#include <gtest/gtest.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include "clearway/planning/earliest_arrival.h"
#include "clearway/planning/path_check.h"
#include "planning/road_crossing.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using std::chrono::seconds;

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
