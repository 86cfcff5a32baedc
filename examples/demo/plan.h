// Planning a crossing with OMPL, through any state checker.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/state_checker.h"
#include "clearway/geometry/timed_pose.h"
#include "demo/crossing.h"

namespace clearway::demo {

// How careful the plan is, and how hard it is looked for. A plain value.
struct PlanSettings {
  // To keep clear of everything; the first with which there is a place that poses the problem.
  std::vector<double> margins_m{0.15, 0.1};
  // Predictions are not the truth: the distance to keep clear of what moves grows with them. The
  // first is about twice what constant motion misses traffic by after a second; where it leaves no
  // way, the next is tried.
  std::vector<double> inflations_mps{1.0, 0.6, 0.4, 0.2};
  // Between sparse beams there are holes that no ray has crossed.
  double max_unknown_fraction = 0.5;
  double ground_clearance_m = 0.2;  // of the robot over the fitted ground: two voxels
  double max_turn_radps = 1.5;
  unsigned int iterations = 3000;  // ways the planner follows, with each inflation
  std::vector<ObjectId> ignored_objects;
};

// A plan and what it is based on.
struct Plan {
  std::string planner;
  double inflation_mps = 0;     // that it was made with
  std::vector<TimedPose> path;  // of the robot's box, at its centre
  // Mean share of the robot's volume in unknown space, if that was asked.
  std::optional<double> unknown_fraction = std::nullopt;
  std::uint64_t version = 0;       // of the scene
  std::size_t states_checked = 0;  // along the final path
};

// A path from start to goal before the time limit that `checker`'s scene version leaves free, with
// the first inflation that has one. NOT_FOUND if none has; the checker's error if it failed.
absl::StatusOr<Plan> PlanCrossing(std::shared_ptr<const StateChecker> checker,
                                  const Crossing& crossing, const GroundPlane& ground,
                                  const PlanSettings& settings);

// Whether what is there besides `settings.ignored_objects` leaves start and goal free and a way
// between them that is easy to find. FAILED_PRECONDITION says what is in the way.
absl::Status CheckRoom(const std::shared_ptr<const StateChecker>& checker, const Crossing& crossing,
                       const GroundPlane& ground, PlanSettings settings);

}  // namespace clearway::demo
