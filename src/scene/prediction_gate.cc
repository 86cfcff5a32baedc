#include "scene/prediction_gate.h"

#include <algorithm>
#include <vector>

namespace clearway {
namespace {

struct Interval {
  double min, max;
  double size() const { return max - min; }
};

// Where most of the points lie along an axis.
Interval SpreadOf(std::span<const Eigen::Vector3d> points, int axis) {
  constexpr std::size_t kMany = 20;
  std::vector<double> values;
  values.reserve(points.size());
  for (const Eigen::Vector3d& p : points) values.push_back(p[axis]);
  const std::size_t skipped = values.size() < kMany ? 0 : values.size() / 20;
  const auto nth = [&](std::size_t n) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(n);
    std::ranges::nth_element(values, place);
    return *place;
  };
  const double min = nth(skipped);
  return {min, nth(values.size() - 1 - skipped)};
}

// By how much `box` has to move to hold `points`, or to be held by them.
double OffsetOf(const Interval& box, const Interval& points) {
  const bool fits = points.size() <= box.size();
  const Interval& outer = fits ? box : points;
  const Interval& inner = fits ? points : box;
  double outer_moves = 0;
  if (inner.max > outer.max) outer_moves = inner.max - outer.max;
  if (inner.min < outer.min) outer_moves = inner.min - outer.min;
  return fits ? outer_moves : -outer_moves;
}

}  // namespace

GateOffset OffsetFrom(const MovingObject& object, const Pose& T_W_O,
                      std::span<const Eigen::Vector3d> points_W) {
  const Aabb& box_O = object.placed_box_O ? *object.placed_box_O : object.observed_box_O;
  if (box_O.Empty() || points_W.empty()) return {};
  const double voxel_m = object.map_O.grid().resolution_m();
  const Pose T_O_W = Inverse(T_W_O);
  std::vector<Eigen::Vector3d> points_O;
  points_O.reserve(points_W.size());
  for (const Eigen::Vector3d& p_W : points_W) points_O.push_back(T_O_W * p_W);

  Eigen::Vector3d off_O = Eigen::Vector3d::Zero(), exact_off_O, half_size;
  double wider_m = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval points = SpreadOf(points_O, axis);
    const Interval box{box_O.min[axis], box_O.max[axis]};
    exact_off_O[axis] = OffsetOf(box, points);
    if (std::abs(exact_off_O[axis]) > 2 * voxel_m) off_O[axis] = exact_off_O[axis];
    wider_m = std::max(wider_m, points.size() - box.size());
    half_size[axis] = 0.5 * std::min(box.size(), std::max(points.size(), voxel_m));
  }
  const double off_m = off_O.norm();
  return {T_W_O.rotation * off_O, T_W_O.rotation * exact_off_O,
          off_m == 0 ? 0 : half_size.dot(off_O.cwiseAbs()) / off_m, wider_m};
}

bool MeetsPrediction(const GateOffset& offset, double bound_m) {
  return offset.off_W.norm() <= bound_m + offset.half_size_m;
}

Aabb GrownByView(const Aabb& box_O, std::span<const Eigen::Vector3d> points_O) {
  constexpr double kRounding_m = 1e-6;
  Aabb grown_O = box_O;
  if (box_O.Empty() || points_O.empty()) return grown_O;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval points = SpreadOf(points_O, axis);
    const bool hold =
        points.min <= box_O.min[axis] + kRounding_m && points.max >= box_O.max[axis] - kRounding_m;
    if (!hold) continue;
    grown_O.min[axis] = std::min(grown_O.min[axis], points.min);
    grown_O.max[axis] = std::max(grown_O.max[axis], points.max);
  }
  return grown_O;
}

}  // namespace clearway
