// When a robot can set out on a motion.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/motion.h"
#include "clearway/collision/safe_intervals.h"

namespace clearway {

// A plain value.
struct DepartureIntervalOptions {
  MotionOptions motion;  // without `world_at`
  // Departures that are no further apart than this, and are not free by one proof, are given up.
  Duration resolution = std::chrono::milliseconds(50);
};

// For each edge the intervals of departures within the window in which it is free: ascending, apart
// from each other. An edge is a motion whose knots' times count from the departure, which is
// Time(): who departs at d is at the knot of time Time() + s at d + s. Deviations are as of any
// motion, and the knots of an edge may just as well have times of their own: d is then a delay.
//
// Guaranteed is: who departs at any time of an interval, its ends and all between them, and follows
// the edge, is free at every moment from the first knot to the last, by proof
// (StateChecker::CheckMotions) for all of these departures, not for some of them. Nothing is said
// of the robot before it departs or after it has arrived: for that there is FindSafeIntervals.
//
// Missed may be what is free by little: departures up to `resolution` apart are proved at once,
// for the robot grown by how far it moves in half of that time. So an interval may begin late or
// end early by about the resolution, and by more where the robot passes an object that is slower
// than itself; one of less than the resolution may be missed; and in a passage that leaves less
// room than that on each side nothing is found. A finer resolution finds it.
//
// Works on any checker; a remote one is asked about all edges at once, in about twice as many calls
// as the window can be halved until the resolution is reached, more for large batches. An edge
// takes at most a few times as many proofs as the window holds resolutions: so many where there is
// hardly room, and few where there is or where something stands in the way. Errors are the
// checker's, and INVALID_ARGUMENT naming the field: what Validate says of the edges and options, a
// `world_at`, a window that ends before it begins, holds more than 100,000 resolutions or, with the
// edges, exceeds 2^62 ns, a resolution that is not above 0.
absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindDepartureIntervals(
    const StateChecker& checker, const MotionBatch& edges, const TimeInterval& window,
    const DepartureIntervalOptions& options);

}  // namespace clearway
