// The OMPL side of a PlanTask.
#pragma once

#include <memory>

#include "clearway/collision/plan_task.h"
#include "clearway/planning/space_time.h"
#include "clearway/planning/state_mapping.h"

namespace clearway {

// The task's space and time, in seconds after the start.
std::shared_ptr<SpaceTimeStateSpace> SpaceOf(const PlanTask& task);
StateMapping MappingOf(const PlanTask& task, const Robot& robot);
// The task with the clearance above the ground that suits the checker's scene, if it has none. A
// checker that shows no scene is taken to have voxels of the default size.
PlanTask WithClearance(PlanTask task, const StateChecker& checker);

// A configuration as a state of the space without time, whose bounds have to be enforced, and back.
void WriteConfiguration(const ConfigurationSpace& space, const std::vector<double>& values,
                        ompl::base::State* part);
std::vector<double> ReadConfiguration(const ConfigurationSpace& space,
                                      const ompl::base::State* part);

}  // namespace clearway
