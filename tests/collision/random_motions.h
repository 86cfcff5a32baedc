// Random motions in random worlds, and their states at any time.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "clearway/collision/motion.h"
#include "clearway/collision/state_checker.h"
#include "collision/link_motion.h"
#include "collision/random_world.h"

namespace clearway {

struct Asked {
  MotionBatch motions;
  std::size_t links;

  std::size_t count() const { return motions.knot_counts.size(); }
};

// The state between two knots at this time, as the motions promise.
inline StateBatch StatesAt(const Asked& asked, std::size_t first_knot, std::size_t knots,
                           const std::vector<Time>& times) {
  StateBatch states;
  for (const Time t : times) {
    std::size_t k = first_knot;
    while (k + 2 < first_knot + knots && asked.motions.times[k + 1] <= t) ++k;
    const Time from = asked.motions.times[k], until = asked.motions.times[k + 1];
    const double seconds = ToSeconds(until - from), fraction = ToSeconds(t - from) / seconds;
    states.times.push_back(t);
    for (std::size_t link = 0; link < asked.links; ++link) {
      const Pose* const poses = &asked.motions.T_W_L[k * asked.links + link];
      states.T_W_L.push_back(LinkMotion(poses[0], poses[asked.links], seconds).At(fraction));
    }
  }
  return states;
}

// Of two to four knots. Links go together, each a little on its own.
inline Asked RandomMotions(RandomWorld& random, const Robot& robot, int count) {
  Asked asked{{}, robot.links.size()};
  for (int m = 0; m < count; ++m) {
    const StateBatch start = random.States(robot, 1);
    const int knots = 2 + random.Below(3);
    asked.motions.knot_counts.push_back(knots);
    Time t = start.times[0];
    std::vector<Pose> T_W_L = start.T_W_L;
    for (int k = 0; k < knots; ++k) {
      asked.motions.times.push_back(t);
      asked.motions.T_W_L.insert(asked.motions.T_W_L.end(), T_W_L.begin(), T_W_L.end());
      t += FromSeconds(random.Uniform(0.01, 1.5));
      const double reach_m = random.Below(4) == 0 ? 0 : random.Uniform(0, 1);
      const double turn_rad = random.Below(3) == 0 ? 0 : random.Uniform(0, 1.5);
      const Aabb around{Eigen::Vector3d::Constant(-reach_m), Eigen::Vector3d::Constant(reach_m)};
      const Eigen::Vector3d way_W = random.Point(around);
      const Eigen::AngleAxisd turn(turn_rad,
                                   random.AnyPose(around).rotation * Eigen::Vector3d::UnitZ());
      for (Pose& pose : T_W_L) {
        pose = {Eigen::Quaterniond(turn) * pose.rotation,
                pose.translation + way_W + 0.1 * random.Point(around)};
      }
    }
  }
  return asked;
}

inline MotionOptions RandomMotionOptions(RandomWorld& random, const Robot& robot) {
  MotionOptions options;
  options.check = random.Options(robot);
  options.check.clearance_up_to_m.reset();
  options.check.with_unknown_fraction = false;
  return options;
}

}  // namespace clearway
