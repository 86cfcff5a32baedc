// Where the objects of a scenario are, as its file says and not as a scene predicts.
#pragma once

#include <ompl/geometric/PathGeometric.h>

#include <optional>

#include "clearway/planning/state_query.h"
#include "clearway/sim/world.h"
#include "cli/scenario_file.h"

namespace clearway::bench {

// The objects as bodies of the simulator, which shares no code with the checkers.
World TruthOf(const cli::Scenario& scenario);

// The object that the robot touches first on the path, looked at every `step`; none if it touches
// nothing.
std::optional<ObjectId> FirstTouched(const World& truth, const Robot& robot,
                                     const ompl::geometric::PathGeometric& path,
                                     const StateMapping& mapping, Duration step);

}  // namespace clearway::bench
