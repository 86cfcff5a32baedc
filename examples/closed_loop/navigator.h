// What the robot decides on each version of the scene.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clearway/collision/prepared_robot.h"
#include "clearway/collision/state_checker.h"
#include "clearway/scene/scene_snapshot.h"
#include "closed_loop/course.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// How careful the robot is. A plain value.
struct NavigatorOptions {
  // Metres a second by which predictions grow, tried in turn until one leaves a way; {0}: without
  // inflation.
  std::vector<double> inflations_mps{0.6, 0.3, 0.15};
  double padding_m = 0.1;
  // What no ray has crossed. Free: a LiDAR on the robot sees every surface before the robot is
  // there.
  UnknownPolicy unknown = UnknownPolicy::kFree;
  double max_unknown_fraction = 0;
  Duration replan_every = std::chrono::milliseconds(500);
  // What has to be proved of a path on each new version: this much, or to its end.
  Duration proved_for = std::chrono::seconds(4);
};

enum class Choice { kKept, kPlanned, kEvaded };

// A plain value.
struct Decision {
  TimedPath path;
  Choice choice = Choice::kKept;
  double inflation_mps = 0;  // with which it is proved
  Time free_until;           // by proof
};

// Drives to a goal and stays there, as far as the others let it. One thread.
class Navigator {
 public:
  Navigator(const Course& course, const NavigatorOptions& options);

  // The path from `start` on, on the newest scene.
  Decision Decide(ScenePtr scene, const TimedPath::Knot& start);

 private:
  struct Way {
    TimedPath path;
    std::size_t level;  // of inflation
    bool to_goal;
  };
  CheckOptions Checks(double inflation_mps) const;
  std::optional<Way> Plan(const TimedPath::Knot& start) const;
  std::optional<Time> Proved(const Way& way, Time from) const;
  Decision Evade(const TimedPath::Knot& start);

  Course course_;
  NavigatorOptions options_;
  std::shared_ptr<const PreparedRobot> robot_;
  std::shared_ptr<const StateChecker> checker_;  // of the newest version
  std::optional<Way> way_;                       // that is followed
  std::optional<Time> planned_at_;
};

}  // namespace clearway::closed_loop
