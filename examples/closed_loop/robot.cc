#include "closed_loop/robot.h"

#include <algorithm>

namespace clearway::closed_loop {

Pose Carrier::LinkPose(const Eigen::Vector2d& p_W) const {
  const double ground_m = ground.height_m ? ground.height_m(p_W.x(), p_W.y()) : 0;
  const double above_ground_m = ground.clearance_m - BoundingBox(body).min.z();
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())),
          {p_W.x(), p_W.y(), ground_m + above_ground_m}};
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
