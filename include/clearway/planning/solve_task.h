// A planning problem as data, solved.
#pragma once

#include <functional>
#include <memory>

#include "absl/status/statusor.h"
#include "clearway/collision/plan_task.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// Plans for the checker's robot on its scene version, with SafeIntervalPlanner, for at most
// `budget` of wall clock time or until `cancelled` (asked now and then) says so: each plan that
// arrives earlier than all before it goes to `found`, the last one is the best. A plan's
// motion is proved free before it is shown. What a SceneChecker is asked when the budget ends may
// take 0.1 s more; a remote checker keeps to its own deadline.
//
// INVALID_ARGUMENT as Validate(task), for a start in the scene's past and for a time limit in which
// the goal cannot be reached at full speed; else the first failure of the checker, if no plan was
// found in spite of it.
absl::StatusOr<PlanOutcome> Solve(const PlanTask& task, std::shared_ptr<const StateChecker> checker,
                                  Duration budget, const std::function<void(const Plan&)>& found,
                                  const std::function<bool()>& cancelled);

}  // namespace clearway
