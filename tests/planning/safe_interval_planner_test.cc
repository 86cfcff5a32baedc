// The planner over safe intervals, its plans verified against the analytic world.
#include "clearway/planning/safe_interval_planner.h"

#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalStates.h>

#include "clearway/planning/path_check.h"
#include "clearway/planning/space_time_setup.h"
#include "planning/road_crossing.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

double ArrivalOf(const og::PathGeometric& path) {
  return SpaceTimeStateSpace::SecondsOf(path.getState(path.getStateCount() - 1));
}

// Until the planner has asked so often whether to go on.
ob::PlannerStatus Solve(ob::Planner& planner, const ob::ProblemDefinitionPtr& problem,
                        unsigned int questions) {
  planner.setProblemDefinition(problem);
  planner.setup();
  ob::IterationTerminationCondition limit(questions);
  return planner.solve(limit);
}

TEST(SafeIntervalPlanner, GoesStraightAheadWhereNothingMovesAndEnds) {
  Crossing crossing({});
  SafeIntervalPlanner dut(crossing.si);
  EXPECT_EQ(Solve(dut, crossing.problem, 1'000'000'000), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_NEAR(ArrivalOf(crossing.Path()), 4, 1e-6);
  ExpectFreeInTheWorld(crossing);
}

TEST(SafeIntervalPlanner, PastOneVehicleAndThroughTwoLanes) {
  for (const auto& discs : {OneVehicle(), TwoLanes()}) {
    for (int run = 0; run < 8; ++run) {
      Crossing crossing(discs);
      SafeIntervalPlanner dut(crossing.si);
      ASSERT_EQ(Solve(dut, crossing.problem, 3000), ob::PlannerStatus::EXACT_SOLUTION);
      EXPECT_TRUE(CheckPath(crossing.Path(), *QueryOf(*crossing.si)).free);
      ExpectFreeInTheWorld(crossing);
    }
  }
}

// Where there is no room to dodge, the best is to wait as short as can be and go: that is computed
// from the world alone.
TEST(SafeIntervalPlanner, WaitsAsShortAsCanBeInACorridor) {
  std::vector<MovingDisc> discs;
  for (int i = 0; i < 6; ++i) AddVehicle(-9 - 9 * i, 0, 5, discs);
  const auto checker = std::make_shared<DiscChecker>(DeliveryRobot(), discs);
  auto corridor = MakeRn(2, 5);
  ob::RealVectorBounds bounds(2);
  bounds.low = {-0.001, -5};
  bounds.high = {0.001, 5};
  corridor->setBounds(bounds);
  const auto space = std::make_shared<SpaceTimeStateSpace>(corridor, SpeedLimits{2.0, 1.5},
                                                           std::chrono::seconds(60));
  const auto mapping = StateMapping::R2(DeliveryRobot(), {}, TimeSince{Time()});
  const auto si = MakeSpaceInformation(space, checker, mapping, {}).value();
  const auto start = MakeState(space, {0, -4, 0}), goal = MakeState(space, {0, 4, 0});

  double optimum_s = 0;
  for (bool free = false; !free; optimum_s += 0.002) {
    auto waited = start, there = goal;
    SpaceTimeStateSpace::SetSeconds(waited.get(), optimum_s);
    SpaceTimeStateSpace::SetSeconds(there.get(), optimum_s + 4);
    free = si->checkMotion(waited.get(), there.get());
    if (free) optimum_s += 4;
  }
  ASSERT_GT(optimum_s, 4.5);

  const auto problem =
      MakeSpaceTimeProblem(si, start.get(), SpaceTimeStateSpace::SpacePart(goal.get()), {}).value();
  SafeIntervalPlanner dut(si);
  ASSERT_EQ(Solve(dut, problem, 2000), ob::PlannerStatus::EXACT_SOLUTION);
  const double arrival_s = ArrivalOf(*problem->getSolutionPath()->as<og::PathGeometric>());
  EXPECT_LE(arrival_s, 1.05 * optimum_s);
  EXPECT_GE(arrival_s, 0.99 * optimum_s);
}

TEST(SafeIntervalPlanner, EveryReportedArrivalIsEarlierThanTheOneBefore) {
  Crossing crossing(TwoLanes());
  SafeIntervalPlanner dut(crossing.si);
  std::vector<double> arrivals_s;
  crossing.problem->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>& states, ob::Cost cost) {
        ASSERT_FALSE(states.empty());
        arrivals_s.push_back(cost.value());
      });
  ASSERT_EQ(Solve(dut, crossing.problem, 8000), ob::PlannerStatus::EXACT_SOLUTION);
  ASSERT_GT(arrivals_s.size(), 1u);
  EXPECT_TRUE(std::ranges::is_sorted(arrivals_s, std::greater<>()));
  EXPECT_NEAR(arrivals_s.back(), ArrivalOf(crossing.Path()), 1e-9);
  EXPECT_NEAR(std::stod(dut.getPlannerProgressProperties().at("best cost REAL")()),
              arrivals_s.back(), 1e-5);

  const ob::PlannerStatus more = [&] {
    ob::IterationTerminationCondition limit(8000);
    return dut.solve(limit);
  }();
  EXPECT_EQ(more, ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_LE(ArrivalOf(crossing.Path()), arrivals_s.back() + 1e-9);

  ob::PlannerData data(crossing.si);
  dut.getPlannerData(data);
  EXPECT_EQ(data.numStartVertices(), 1u);
  EXPECT_EQ(data.numEdges() + 1, data.numVertices());
  const unsigned int vertices = data.numVertices();
  dut.getPlannerData(data);
  EXPECT_EQ(data.numVertices(), vertices);
  ob::PlannerData again(crossing.si);  // does not take away the states of the first
  dut.getPlannerData(again);
  EXPECT_TRUE(
      crossing.si->equalStates(data.getVertex(0).getState(), again.getVertex(0).getState()));
}

TEST(SafeIntervalPlanner, GivesItsPathAgainToAProblemThatHasLostIt) {
  Crossing crossing(OneVehicle());
  SafeIntervalPlanner dut(crossing.si);
  ASSERT_EQ(Solve(dut, crossing.problem, 500), ob::PlannerStatus::EXACT_SOLUTION);
  crossing.problem->clearSolutionPaths();
  ASSERT_EQ(Solve(dut, crossing.problem, 500), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_TRUE(crossing.problem->hasExactSolution());
}

TEST(SafeIntervalPlanner, BeginsAnotherProblemAnew) {
  Crossing crossing({});
  SafeIntervalPlanner dut(crossing.si);
  ASSERT_EQ(Solve(dut, crossing.problem, 500), ob::PlannerStatus::EXACT_SOLUTION);
  const auto back = MakeSpaceTimeProblem(crossing.si, crossing.goal.get(),
                                         SpaceTimeStateSpace::SpacePart(crossing.start.get()), {})
                        .value();
  ASSERT_EQ(Solve(dut, back, 500), ob::PlannerStatus::EXACT_SOLUTION);
  const auto& path = *back->getSolutionPath()->as<og::PathGeometric>();
  EXPECT_TRUE(crossing.si->equalStates(path.getState(0), crossing.goal.get()));
  EXPECT_TRUE(back->getGoal()->isSatisfied(path.getState(path.getStateCount() - 1)));
}

TEST(SafeIntervalPlanner, EndsWithAPathThatIsGoodEnoughForTheObjective) {
  Crossing crossing(TwoLanes());
  const auto any = std::make_shared<EarliestArrivalObjective>(crossing.si);
  any->setCostThreshold(any->infiniteCost());
  crossing.problem->setOptimizationObjective(any);
  SafeIntervalPlanner dut(crossing.si);
  int paths = 0;
  crossing.problem->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>&, ob::Cost) { ++paths; });
  ASSERT_EQ(Solve(dut, crossing.problem, 1'000'000'000), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(paths, 1);
}

TEST(SafeIntervalPlanner, ItsDataTellTheGoal) {
  Crossing crossing({});
  SafeIntervalPlanner dut(crossing.si);
  ASSERT_EQ(Solve(dut, crossing.problem, 1'000'000'000), ob::PlannerStatus::EXACT_SOLUTION);
  ob::PlannerData data(crossing.si);
  dut.getPlannerData(data);
  EXPECT_GE(data.numGoalVertices(), 1u);
  for (unsigned int i = 0; i < data.numGoalVertices(); ++i) {
    EXPECT_TRUE(crossing.problem->getGoal()->isSatisfied(data.getGoalVertex(i).getState()));
  }
}

// Of OMPL's own goals the times count.
TEST(SafeIntervalPlanner, IsAtAGoalStateAtItsTime) {
  for (const double at_s : {4.0, 8.3, 11.9}) {
    Crossing crossing(TwoLanes());
    SpaceTimeStateSpace::SetSeconds(crossing.goal.get(), at_s);
    crossing.problem->clearGoal();
    crossing.problem->setGoalState(crossing.goal);
    SafeIntervalPlanner dut(crossing.si);
    ASSERT_EQ(Solve(dut, crossing.problem, 3000),
              at_s > 4 ? ob::PlannerStatus::EXACT_SOLUTION : ob::PlannerStatus::TIMEOUT);
    if (at_s == 4) continue;  // another is in the way
    EXPECT_EQ(ArrivalOf(crossing.Path()), at_s);
    EXPECT_TRUE(CheckPath(crossing.Path(), *QueryOf(*crossing.si)).free);
    ExpectFreeInTheWorld(crossing);
  }
}

TEST(SafeIntervalPlanner, TakesTheGoalStateThatComesFirst) {
  Crossing crossing({});
  const auto goals = std::make_shared<ob::GoalStates>(crossing.si);
  for (const double at_s : {9.0, 3.0, 7.0}) {  // 3 s are too few
    SpaceTimeStateSpace::SetSeconds(crossing.goal.get(), at_s);
    goals->addState(crossing.goal);
  }
  crossing.problem->setGoal(goals);
  SafeIntervalPlanner dut(crossing.si);
  ASSERT_EQ(Solve(dut, crossing.problem, 3000), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(ArrivalOf(crossing.Path()), 7);
}

TEST(SafeIntervalPlanner, AWallOfVehiclesHasNoPlan) {
  std::vector<MovingDisc> discs;
  for (int i = 0; i < 40; ++i) AddVehicle(-5.0 * i + 10, 0, 7, discs);
  Crossing crossing(discs);
  SafeIntervalPlanner dut(crossing.si);
  EXPECT_EQ(Solve(dut, crossing.problem, 3000), ob::PlannerStatus::TIMEOUT);
  EXPECT_FALSE(crossing.problem->hasSolution());
}

TEST(SafeIntervalPlanner, SaysWhatIsWrongWithStartAndGoal) {
  Crossing in_collision({{{0, -4}, {0, 0}, 1}});
  SafeIntervalPlanner at_start(in_collision.si);
  EXPECT_EQ(Solve(at_start, in_collision.problem, 100), ob::PlannerStatus::INVALID_START);

  Crossing beyond({{{0, 4}, {0, 0}, 1}});
  SafeIntervalPlanner at_goal(beyond.si);
  EXPECT_EQ(Solve(at_goal, beyond.problem, 100), ob::PlannerStatus::INVALID_GOAL);

  auto no_time = std::make_shared<ob::SpaceInformation>(MakeSe2(5));
  SafeIntervalPlanner timeless(no_time);
  EXPECT_THROW(timeless.setup(), ompl::Exception);
}

// With OMPL's own checks, at steps.
TEST(SafeIntervalPlanner, PlansOverAnySpaceInformation) {
  Crossing crossing(TwoLanes());
  const StateQuery& query = *QueryOf(*crossing.si);
  const auto plain = std::make_shared<ob::SpaceInformation>(crossing.space);
  plain->setStateValidityChecker(
      [&](const ob::State* state) { return query.CheckState(state).status == SpaceStatus::kFree; });
  plain->setStateValidityCheckingResolution(0.001);
  plain->setup();
  crossing.problem = MakeSpaceTimeProblem(plain, crossing.start.get(),
                                          SpaceTimeStateSpace::SpacePart(crossing.goal.get()), {})
                         .value();
  SafeIntervalPlanner dut(plain);
  ASSERT_EQ(Solve(dut, crossing.problem, 3000), ob::PlannerStatus::EXACT_SOLUTION);
  ExpectFreeInTheWorld(crossing);
}

TEST(SpaceTimeSetup, SolvesAtOnceAndSaysWhatIsWrong) {
  const Crossing crossing(OneVehicle());
  const auto mapping = StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()});
  const ob::State* const goal = SpaceTimeStateSpace::SpacePart(crossing.goal.get());
  const auto dut = [&](GoalOptions options) {
    return MakeSpaceTimeSetup(crossing.space, crossing.checker, mapping, {}, crossing.start.get(),
                              goal, options);
  };
  const auto setup = dut({});
  ASSERT_TRUE(setup.ok()) << setup.status();
  ASSERT_EQ((*setup)->solve(0.5), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_LE(ArrivalOf((*setup)->getSolutionPath()), 7);
  EXPECT_EQ(dut({.latest = std::chrono::seconds(1)}).status().code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace clearway
