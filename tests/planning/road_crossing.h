// A road to cross in SE(2) and time, among vehicles whose ways are known exactly.
#pragma once

#include <gtest/gtest.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>  // no include guard
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "clearway/planning/space_information.h"
#include "clearway/planning/space_time_problem.h"
#include "planning/disc_world.h"
#include "planning/fixtures.h"

namespace clearway {

// The fastest object moves 7 m/s * 25 ms between two checked states: with half of that as padding,
// a plan is free at every instant.
inline constexpr double kPaddingMetres = 0.0875;

// A vehicle of 5 m x 2 m along x, of discs.
inline void AddVehicle(double x_m, double y_m, double speed_mps, std::vector<MovingDisc>& discs) {
  for (double offset_m : {-1.5, -0.5, 0.5, 1.5}) {
    discs.push_back({{x_m + offset_m, y_m}, {speed_mps, 0}, 1.0});
  }
}

// One vehicle, at the robot's straight way when the robot would be.
inline std::vector<MovingDisc> OneVehicle() {
  std::vector<MovingDisc> discs;
  AddVehicle(-14, 0, 7, discs);
  return discs;
}

// Traffic on two lanes.
inline std::vector<MovingDisc> TwoLanes() {
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
    space = std::make_shared<SpaceTimeStateSpace>(MakeSe2(5), SpeedLimits{2.0, 1.5},
                                                  std::chrono::seconds(12));
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
  bool Solve(ompl::base::Planner& planner, unsigned int iterations) {
    planner.setProblemDefinition(problem);
    planner.setup();
    ompl::base::IterationTerminationCondition limit(iterations);
    const ompl::base::PlannerTerminationCondition until(
        [&] { return limit.eval() || problem->hasExactSolution(); });
    planner.solve(until);
    return problem->hasExactSolution();
  }
  const ompl::geometric::PathGeometric& Path() const {
    return *problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  }

  std::shared_ptr<DiscChecker> checker;
  std::shared_ptr<SpaceTimeStateSpace> space;
  ompl::base::SpaceInformationPtr si;
  ompl::base::ScopedState<> start{MakeSe2()}, goal{MakeSe2()};
  ompl::base::ProblemDefinitionPtr problem;
};

// Every 5 ms, from the definition of the space and the world alone.
inline void ExpectFreeInTheWorld(const Crossing& crossing) {
  const ompl::geometric::PathGeometric& path = crossing.Path();
  const auto& mapping = QueryOf(*crossing.si)->mapping();
  ompl::base::ScopedState<> state(crossing.space);
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    const ompl::base::State *a = path.getState(i - 1), *b = path.getState(i);
    const double a_s = SpaceTimeStateSpace::SecondsOf(a), b_s = SpaceTimeStateSpace::SecondsOf(b);
    ASSERT_GE(b_s, a_s);
    const auto* pa = SpaceTimeStateSpace::SpacePart(a)->as<ompl::base::SE2StateSpace::StateType>();
    const auto* pb = SpaceTimeStateSpace::SpacePart(b)->as<ompl::base::SE2StateSpace::StateType>();
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
  const ompl::base::State* end = path.getState(path.getStateCount() - 1);
  EXPECT_LE(SpaceTimeStateSpace::SecondsOf(end), 12);
  EXPECT_TRUE(crossing.problem->getGoal()->isSatisfied(end));
}

}  // namespace clearway
