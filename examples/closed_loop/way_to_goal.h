// Planning the way to the goal.
#pragma once

#include <memory>
#include <optional>

#include "clearway/collision/state_checker.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// A plain value.
struct WayQuestion {
  TimedPath::Knot start;
  Errand errand;                               // but for its start
  Duration latest = std::chrono::seconds(16);  // from the start to the arrival
  // How often the planner may ask whether to go on: effort, not time, so that what comes of it does
  // not depend on the machine.
  unsigned int iterations = 1500;
};

// The earliest arrival found by SafeIntervalPlanner, every leg and wait of it proved free; none if
// none was found.
std::optional<TimedPath> FindWay(const std::shared_ptr<const StateChecker>& checker,
                                 const WayQuestion& question, const CheckOptions& options);

}  // namespace clearway::closed_loop
