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
  // Predictions are not the truth: to keep clear of everything, and per second more of what moves.
  double margin_m = 0.15;
  double inflation_mps = 0.2;
  // Between sparse beams there are holes that no ray has crossed.
  double max_unknown_fraction = 0.5;
  double ground_clearance_m = 0.2;  // of the robot over the fitted ground: two voxels
  double max_turn_radps = 1.5;
  unsigned int iterations = 12000;  // of the planner, for a first path
  std::vector<ObjectId> ignored_objects;
};

CheckOptions CheckOptionsOf(const PlanSettings& settings);

// A plan and what it is based on.
struct Plan {
  std::string planner;
  std::vector<TimedPose> path;     // of the robot's box, at its centre
  double unknown_fraction = 0;     // mean share of the robot's volume in unknown space
  std::uint64_t version = 0;       // of the scene
  std::size_t states_checked = 0;  // along the final path
};

// A path from start to goal before the time limit that `checker`'s scene version leaves free.
// NOT_FOUND if none was found; the checker's error if it failed.
absl::StatusOr<Plan> PlanCrossing(std::shared_ptr<const StateChecker> checker,
                                  const Crossing& crossing, const GroundPlane& ground,
                                  const PlanSettings& settings);

// Whether the static map alone leaves room: start and goal are free, and there is a plan past
// everything but `objects`. FAILED_PRECONDITION says where there is none.
absl::Status CheckStaticRoom(std::shared_ptr<const StateChecker> checker, const Crossing& crossing,
                             const GroundPlane& ground, const std::vector<ObjectId>& objects,
                             PlanSettings settings);

}  // namespace clearway::demo
