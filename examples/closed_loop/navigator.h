// What the robot decides on each version of the scene.
#pragma once

#include <memory>
#include <optional>

#include "clearway/collision/prepared_robot.h"
#include "clearway/collision/state_checker.h"
#include "clearway/scene/scene_snapshot.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// How careful the robot is. A plain value.
struct NavigatorOptions {
  // Metres a second by which predictions grow with their age; 0: not at all.
  double inflation_mps = 0.7;
  // Beside that, as CheckOptions::bound_multiple.
  double bound_multiple = 0;
  // If set, ways are looked for with this, and have to be proved with `inflation_mps` for
  // `surely_for` only: what is later will have been seen again. Where that finds none, with
  // `inflation_mps` all the way.
  std::optional<double> later_inflation_mps = std::nullopt;
  Duration surely_for = std::chrono::seconds(2);
  double padding_m = 0.1;
  bool inflate_moving_only = false;
  // What no ray has crossed. Free: a LiDAR on the robot sees every surface before the robot is
  // there.
  UnknownPolicy unknown = UnknownPolicy::kFree;
  double max_unknown_fraction = 0;
  // What has to be proved of a path: this much of the time to come, and all the way to the goal.
  Duration proved_for = std::chrono::seconds(4);
};

enum class Choice { kKept, kPlanned, kEvaded };

// A plain value.
struct Decision {
  TimedPath path;
  Choice choice = Choice::kKept;
  Time free_until;  // by proof
};

// Drives to a goal and stays there, as far as the others let it. One thread.
class Navigator {
 public:
  Navigator(const Errand& errand, const NavigatorOptions& options);

  // Whether the way to the goal that is followed is still proved on a newer scene; not, if none is.
  bool StillGood(ScenePtr scene, const TimedPath::Knot& start);
  // The path from `start` on, on the newest scene.
  Decision Decide(ScenePtr scene, const TimedPath::Knot& start);

 private:
  // A way to the goal, and the inflation with which all of it is proved.
  struct Way {
    TimedPath path;
    double inflation_mps;
  };

  CheckOptions Checks(double inflation_mps) const;
  // Up to when the way to the goal is proved free; none if that is not enough to follow it.
  std::optional<Time> Proved(const Way& way, Time from) const;
  std::optional<Way> Plan(const TimedPath::Knot& start) const;
  std::optional<Way> PlanWith(double inflation_mps, const TimedPath::Knot& start) const;
  Decision Evade(const TimedPath::Knot& start) const;

  Errand errand_;
  NavigatorOptions options_;
  std::shared_ptr<const PreparedRobot> robot_;
  std::shared_ptr<const StateChecker> checker_;  // of the newest version
  std::optional<Way> way_;                       // that is followed
};

}  // namespace clearway::closed_loop
