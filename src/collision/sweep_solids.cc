#include <algorithm>
#include <cmath>

#include "collision/body_contact.h"

namespace clearway {

FirstTouch TouchBox(const Aabb& box_F, const Sweep& sweep, double until) {
  const double contact_m = sweep.margin_m + kContact_m;
  if (sweep.AtRest() && sweep.shape_F.DistanceTo(box_F, contact_m) > contact_m) return {};
  const auto farthest_F = [&](const Eigen::Vector3d& direction_F) -> Eigen::Vector3d {
    return (direction_F.array() > 0).select(box_F.max, box_F.min);
  };
  return {FirstTouchOf(sweep, {farthest_F, box_F.Center()}, 0, 0, until), std::nullopt};
}

FirstTouch TouchShape(const ShapeGeometry& shape, const Sweep& sweep, double until) {
  if (sweep.AtRest() && !sweep.shape_F.Meets(shape, {}, sweep.margin_m + kContact_m)) return {};
  if (const auto cylinders = sweep.shape_F.BesideCylinder(shape, {})) {
    const auto share = cylinders->FirstTouch(sweep.way_F, sweep.LargestMargin(), until);
    if (share && (*share == kNever || sweep.spread_F.empty())) return {*share, std::nullopt};
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
  const double contact_m = sweep.margin_m + kContact_m;
  if (sweep.AtRest() && sweep.shape_F.DistanceToBall(center_F, radius_m, contact_m) > contact_m) {
    return {};
  }
  const auto farthest_F = [&](const Eigen::Vector3d&) { return center_F; };
  return {FirstTouchOf(sweep, {farthest_F, center_F}, radius_m, 0, until), std::nullopt};
}

FirstTouch LeaveBounds(const Aabb& bounds_F, const Sweep& sweep) {
  constexpr double kMayExceed_m = 0.5 * kContact_m;  // the other half is kept
  const Aabb box = sweep.BoxAtStart();
  double share = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = sweep.way_F[axis];
    const double before = box.min[axis] - bounds_F.min[axis] + kMayExceed_m;
    const double behind = bounds_F.max[axis] - box.max[axis] + kMayExceed_m;
    // What is not a number is out of bounds.
    if (!(before >= 0 && behind >= 0 && std::abs(way) >= 0)) return {0, std::nullopt};
    const double left = way > 0 ? behind : before;
    if (std::abs(way) > left) share = std::min(share, left / std::abs(way));
  }
  return {share, std::nullopt};
}

}  // namespace clearway
