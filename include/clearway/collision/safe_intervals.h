// When a robot can stand somewhere.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// From `from` to `until`, both included.
struct TimeInterval {
  Time from, until;
  bool operator==(const TimeInterval&) const = default;
};

// A plain value.
struct SafeIntervalOptions {
  CheckOptions check;  // as of MotionOptions
  // How often it is looked whether the robot can stand there again: an interval may begin that much
  // late, and one that is shorter may be missed.
  Duration look_every = std::chrono::milliseconds(50);
};

// For each configuration (one pose T_W_L for each of the robot's links, one configuration after
// the other) the intervals within the window in which the robot, at rest there, is free at every
// moment, by proof (StateChecker::CheckMotions): ascending, apart from each other. Where a proof
// stays unresolved (a part that is an open mesh, within whose hull something lies) an interval
// ends, and what is found may be no longer than a look.
//
// Works on any checker; a remote one is asked about all configurations at once, in two calls for
// each interval of the one that has the most, or more where nothing is free for long or of large
// batches. Errors are the checker's, and INVALID_ARGUMENT naming the field: what Validate says of
// the options, poses that are no multiple of the links, a window that ends before it begins or
// holds more than 100,000 looks, looks that are not apart.
absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindSafeIntervals(
    const StateChecker& checker, const std::vector<Pose>& T_W_L, const TimeInterval& window,
    const SafeIntervalOptions& options);

}  // namespace clearway
