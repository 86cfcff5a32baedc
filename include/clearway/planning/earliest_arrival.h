// Plans in space-time that arrive early, from planners that stop at the first plan.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>

#include <memory>

#include "absl/status/statusor.h"
#include "clearway/planning/space_time_problem.h"

namespace clearway {

// Solves MakeSpaceTimeProblem with `planner`, then again and again for an arrival at least
// `improvement` (above zero) earlier, until `until` holds or full speed admits no earlier arrival.
// Each round searches a smaller space than the one before, and its path is straightened: states are
// left out between which the robot may as well go at constant speed. Returns the path that arrives
// first.
// Errors: MakeSpaceTimeProblem's; NOT_FOUND if no round found a path, with the checker's first
// error in the message if there was one; INTERNAL if OMPL throws.
absl::StatusOr<std::shared_ptr<ompl::geometric::PathGeometric>> PlanEarliestArrival(
    const ompl::base::PlannerPtr& planner, const ompl::base::State* start,
    const ompl::base::State* goal_part, GoalOptions options,
    const ompl::base::PlannerTerminationCondition& until,
    Duration improvement = std::chrono::milliseconds(200));

}  // namespace clearway
