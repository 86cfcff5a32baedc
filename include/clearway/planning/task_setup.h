// A planning problem as data, for OMPL's tools.
#pragma once

#include <ompl/geometric/SimpleSetup.h>

#include <memory>

#include "absl/status/statusor.h"
#include "clearway/collision/plan_task.h"
#include "clearway/planning/space_time.h"

namespace clearway {

// MakeSpaceTimeSetup for the task; any other planner that plans in space-time may be set. The space
// goes on for longer than a tight time limit (see GoalOptions::latest). Errors are those of Solve
// that come before the search.
absl::StatusOr<ompl::geometric::SimpleSetupPtr> MakeTaskSetup(
    const PlanTask& task, const std::shared_ptr<const StateChecker>& checker);

}  // namespace clearway
