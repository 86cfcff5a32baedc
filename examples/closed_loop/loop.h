// The closed loop in simulated time: scan, scene, decision, motion.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "closed_loop/course.h"
#include "closed_loop/judge.h"
#include "closed_loop/navigator.h"
#include "closed_loop/scene_feed.h"

namespace clearway::closed_loop {

// A plain value.
struct LoopOptions {
  NavigatorOptions navigator;
  // Scans come at 10 Hz. The planner is asked at a fixed rate, on the version of the newest one.
  std::size_t scans_per_decision = 5;
  bool slam_noise = false;  // of Table I; else exact
  // See FrontEnd.
  Duration motion_over = std::chrono::milliseconds(100);
  std::uint64_t seed = 1;  // of the noise
  Duration lasts = std::chrono::seconds(30);
};

// What the loop is measured with: exact SLAM, or that of Table I. Noise moves what is seen by
// decimetres, so the robot keeps farther away, and velocities over 0.1 s would be noise alone.
LoopOptions MakeLoopOptions(bool slam_noise, bool inflation, std::uint64_t seed);

// What happened at one scan.
struct LoopStep {
  Time time;
  Eigen::Vector2d robot_W;           // true
  std::optional<Decision> decision;  // if it was time for one; takes effect with the next scan
  ScenePtr scene;
};

// A plain value.
struct LoopResult {
  std::optional<Time> arrival;  // first at the goal, as far as SLAM can tell
  std::vector<Collision> collisions;
  std::vector<TimedPath::Knot> driven;  // where the robot truly was
};

// How near counts as there.
inline constexpr double kArrived_m = 0.3;

// Drives through the course. Whoever watches sees every step. Fails only as `feed` does.
absl::StatusOr<LoopResult> RunLoop(const Course& course, const LoopOptions& options,
                                   SceneFeed& feed,
                                   const std::function<void(const LoopStep&)>& watch = nullptr);

}  // namespace clearway::closed_loop
