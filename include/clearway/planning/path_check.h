// What a planned path is, and what the scene says of it.
#pragma once

#include <ompl/geometric/PathGeometric.h>

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/geometry/timed_pose.h"
#include "clearway/planning/state_query.h"

namespace clearway {

// The poses of the robot's first link at the path's states, in their order. Between two of them the
// robot moves as the path's space interpolates: a screw (geometry's Interpolate) between the poses
// is another motion if the robot turns on the way, so call path.interpolate() first where that
// matters. The error is StateMapping::Append's.
absl::StatusOr<std::vector<TimedPose>> TimedPoses(const ompl::geometric::PathGeometric& path,
                                                  const StateMapping& mapping);

// The answers along a path, in the steps of the query's options.
struct PathCheck {
  bool free = false;                 // every answer is kFree, and there is one
  std::vector<Time> times;           // of each answer
  std::vector<StateAnswer> answers;  // the first state, then each motion's in turn
  // The first answer that is not free.
  std::optional<std::size_t> first_blocked;
  // Mean share of the robot's volume in unknown space over all answers: how much unknown space the
  // path crosses. None if the query's options do not ask for it, or a motion could not be checked.
  std::optional<double> unknown_fraction;
};

// Checks every motion of the path with one call of the checker. A motion that cannot be checked
// (StateQuery::CheckMotion) gives one answer, at the time of its end.
PathCheck CheckPath(const ompl::geometric::PathGeometric& path, const StateQuery& query);

}  // namespace clearway
