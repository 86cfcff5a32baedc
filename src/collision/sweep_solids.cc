#include <algorithm>
#include <cmath>

#include "collision/body_contact.h"

namespace clearway {

FirstTouch TouchBox(const Aabb& box_F, const Sweep& sweep, double until) {
  const auto farthest_F = [&](const Eigen::Vector3d& direction_F) -> Eigen::Vector3d {
    return (direction_F.array() > 0).select(box_F.max, box_F.min);
  };
  return {FirstTouchOf(sweep, {farthest_F, box_F.Center()}, 0, 0, until), std::nullopt};
}

FirstTouch TouchShape(const ShapeGeometry& shape, const Sweep& sweep, double until) {
  if (const auto cylinders = sweep.shape_F.BesideCylinder(shape, {})) {
    const auto share = cylinders->FirstTouch(sweep.way_F, sweep.margin_m, until);
    if (share) return {*share, std::nullopt};
  }
  const auto farthest_F = [&](const Eigen::Vector3d& direction_F) {
    return shape.FarthestOfCore(direction_F);
  };
  return {
      FirstTouchOf(sweep, {farthest_F, shape.box_G().Center()}, shape.core_radius_m(), 0, until),
      std::nullopt};
}

FirstTouch TouchBall(const Eigen::Vector3d& center_F, double radius_m, const Sweep& sweep,
                     double until) {
  const auto farthest_F = [&](const Eigen::Vector3d&) { return center_F; };
  return {FirstTouchOf(sweep, {farthest_F, center_F}, radius_m, 0, until), std::nullopt};
}

FirstTouch LeaveBounds(const Aabb& bounds_F, const Sweep& sweep) {
  const Aabb box = sweep.shape_F.box_F().Padded(sweep.margin_m);
  double share = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = sweep.way_F[axis];
    const double before = box.min[axis] - bounds_F.min[axis];
    const double behind = bounds_F.max[axis] - box.max[axis];
    // What is not a number is out of bounds.
    if (!(before >= 0 && behind >= 0 && std::abs(way) >= 0)) return {0, std::nullopt};
    const double left = (way > 0 ? behind : before) - kKept_m;
    if (std::abs(way) > left && way != 0)
      share = std::min(share, std::max(0.0, left) / std::abs(way));
  }
  return {share, std::nullopt};
}

}  // namespace clearway
