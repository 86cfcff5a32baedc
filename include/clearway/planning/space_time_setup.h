// All that it takes to plan in space-time, at once.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <memory>

#include "absl/status/statusor.h"
#include "clearway/planning/space_information.h"
#include "clearway/planning/space_time.h"
#include "clearway/planning/space_time_problem.h"

namespace clearway {

// OMPL's SimpleSetup with SafeIntervalPlanner, for the checker's robot, from `start`, a state of
// `space`, to `goal_part`, a state of its space without time:
//
//   auto setup = MakeSpaceTimeSetup(space, checker, mapping, options, start, goal, {});
//   if (setup.ok() && (*setup)->solve(1.0)) ... (*setup)->getSolutionPath() ...
//
// SimpleSetup::simplifySolution knows no time: leave it. Errors are MakeSpaceInformation's and
// MakeSpaceTimeProblem's, and INVALID_ARGUMENT for a start in the scene's past.
absl::StatusOr<ompl::geometric::SimpleSetupPtr> MakeSpaceTimeSetup(
    const std::shared_ptr<SpaceTimeStateSpace>& space, std::shared_ptr<const StateChecker> checker,
    StateMapping mapping, PlanningOptions options, const ompl::base::State* start,
    const ompl::base::State* goal_part, const GoalOptions& goal_options);

}  // namespace clearway
