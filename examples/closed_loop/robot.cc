#include "closed_loop/robot.h"

#include <algorithm>

namespace clearway::closed_loop {

Robot MakeRobot() {
  return Robot::SingleShape("carrier", Cylinder{kRobotRadius_m, kRobotHeight_m});
}

Pose LinkPose(const Eigen::Vector2d& p_W) {
  return Pose::Translation(p_W.x(), p_W.y(), kGroundClearance_m + 0.5 * kRobotHeight_m);
}

Pose SensorPose(const Eigen::Vector2d& p_W) {
  return Pose::Translation(p_W.x(), p_W.y(), kSensorHeight_m);
}

Eigen::Vector2d TimedPath::At(Time time) const {
  const auto next = std::ranges::upper_bound(knots_, time, {}, &Knot::time);
  if (next == knots_.begin()) return knots_.front().p_W;
  if (next == knots_.end()) return knots_.back().p_W;
  const Knot& last = *std::prev(next);
  const double share = ToSeconds(time - last.time) / ToSeconds(next->time - last.time);
  return last.p_W + share * (next->p_W - last.p_W);
}

}  // namespace clearway::closed_loop
