// Converters of plan_service.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/collision/plan_task.h"
#include "clearway/v1/plan_service.pb.h"
#include "clearway/wire/server_info.h"

namespace clearway {

void Write(const PlanTask& task, v1::PlanRequest* proto);
// Whether it makes sense is for Validate(task, robot), which the solver runs.
absl::StatusOr<PlanTask> ReadPlanTask(const v1::PlanRequest& proto, const ServerLimits& limits);
// RESOURCE_EXHAUSTED above max_planning_s.
absl::StatusOr<Duration> ReadBudget(const v1::PlanRequest& proto, const ServerLimits& limits);

// A plan of the request's task, for a robot of so many links.
void Write(const Plan& plan, const v1::PlanRequest& request, std::size_t links,
           v1::PlannedPath* proto);
// INTERNAL if it does not fit the task and the robot.
absl::StatusOr<Plan> ReadPlan(const v1::PlannedPath& proto, const PlanTask& task,
                              std::size_t links);

void Write(const PlanOutcome& outcome, v1::PlanResponse* proto);
PlanOutcome ReadOutcome(const v1::PlanResponse& proto);

}  // namespace clearway
