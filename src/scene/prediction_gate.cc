#include "scene/prediction_gate.h"

#include <algorithm>
#include <vector>

namespace clearway {
namespace {

struct Interval {
  double min, max;
  double size() const { return max - min; }
};

// Where most of the values lie.
Interval SpreadOf(std::vector<double>& values) {
  constexpr std::size_t kMany = 20;
  const std::size_t skipped = values.size() < kMany ? 0 : values.size() / 20;
  std::ranges::sort(values);
  return {values[skipped], values[values.size() - 1 - skipped]};
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
  const Aabb& box_O = object.observed_box_O;
  if (box_O.Empty() || points_W.empty()) return {};
  const double voxel_m = object.map_O.grid().resolution_m();
  const Pose T_O_W = Inverse(T_W_O);
  std::vector<Eigen::Vector3d> points_O;
  points_O.reserve(points_W.size());
  for (const Eigen::Vector3d& p_W : points_W) points_O.push_back(T_O_W * p_W);

  Eigen::Vector3d off_O = Eigen::Vector3d::Zero(), half_size;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points_O.size());
    for (const Eigen::Vector3d& p_O : points_O) values.push_back(p_O[axis]);
    const Interval points = SpreadOf(values);
    const Interval box{box_O.min[axis], box_O.max[axis]};
    const double off = OffsetOf(box, points);
    if (std::abs(off) > 2 * voxel_m) off_O[axis] = off;
    half_size[axis] = 0.5 * std::min(box.size(), std::max(points.size(), voxel_m));
  }
  const double off_m = off_O.norm();
  if (off_m == 0) return {};
  return {T_W_O.rotation * off_O, half_size.dot(off_O.cwiseAbs()) / off_m};
}

bool MeetsPrediction(const GateOffset& offset, double bound_m) {
  return offset.off_W.norm() <= bound_m + offset.half_size_m;
}

}  // namespace clearway
