#include "clearway/scene/object_extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "clearway/geometry/polygon.h"

namespace clearway {
namespace {

// Slower than this, a direction of motion is noise.
constexpr double kMovingMps = 0.5;

// The centres of the occupied voxels, or a given object's corners; and their outline from above.
struct Footprint {
  std::vector<Eigen::Vector3d> points_O;
  Polygon outline_O;
  bool exact = false;  // told, not seen
};

// The points of it that an outline can have, in O.
template <class Add>
void ForEachPoint(const PlacedPart& part, Add&& add) {
  const MovingObject& object = *part.object;
  if (object.given()) {
    for (const Eigen::Vector3d& vertex : object.solid->hull->vertices) add(part.T_O_P * vertex);
  }
  const VoxelGrid& grid = object.map_O.grid();
  object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int index) { add(part.T_O_P * grid.CenterOf(VoxelAt(block_key, index))); });
  });
}

Footprint FootprintOf(std::span<const PlacedPart> parts) {
  Footprint footprint;
  footprint.exact = parts.front().object->given();
  for (const PlacedPart& part : parts) {
    ForEachPoint(part, [&](const Eigen::Vector3d& p_O) { footprint.points_O.push_back(p_O); });
  }
  std::vector<Eigen::Vector2d> from_above;
  for (const Eigen::Vector3d& p_O : footprint.points_O) from_above.push_back(p_O.head<2>());
  footprint.outline_O = ConvexOutline(from_above);
  // Too thin for an outline: any of them bounds it.
  if (footprint.outline_O.size() < 3) footprint.outline_O = std::move(from_above);
  return footprint;
}

double AreaAt(const Polygon& outline_O, double yaw_rad) {
  const Eigen::Rotation2Dd R_E_O(-yaw_rad);
  Eigen::AlignedBox2d box_E;
  for (const Eigen::Vector2d& p_O : outline_O) box_E.extend(R_E_O * p_O);
  return box_E.volume();
}

// The smallest rectangle lies along an edge of the outline.
double YawOfSmallest(const Polygon& outline_O) {
  double best_rad = 0, best_m2 = AreaAt(outline_O, 0);
  for (std::size_t i = 0; i < outline_O.size(); ++i) {
    const Eigen::Vector2d edge = outline_O[(i + 1) % outline_O.size()] - outline_O[i];
    const double yaw_rad = std::atan2(edge.y(), edge.x());
    const double area_m2 = AreaAt(outline_O, yaw_rad);
    if (area_m2 < best_m2) best_m2 = area_m2, best_rad = yaw_rad;
  }
  return best_rad;
}

// Without that share of the values at each end.
Span1d SpanWithout(double share, std::vector<double> values) {
  const auto skipped = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto low = values.begin() + skipped, high = values.end() - 1 - skipped;
  std::nth_element(values.begin(), low, values.end());
  const double least = *low;
  std::nth_element(low, high, values.end());
  return {*high - least, 0.5 * (*high + least)};
}

// With the length along `yaw_rad`.
ObjectExtent ExtentAt(const Footprint& footprint, double yaw_rad) {
  const Eigen::Quaterniond R_O_E(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  std::array<std::vector<double>, 3> along_E;
  for (const Eigen::Vector3d& p_O : footprint.points_O) {
    const Eigen::Vector3d p_E = R_O_E.conjugate() * p_O;
    for (int axis = 0; axis < 3; ++axis) along_E[axis].push_back(p_E[axis]);
  }
  ObjectExtent extent{.yaw_rad = yaw_rad};
  Eigen::Vector3d center_E;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [length, middle] = footprint.exact ? SpanWithout(0, std::move(along_E[axis]))
                                                  : SpanOf(std::move(along_E[axis]));
    extent.size_m[axis] = length;
    center_E[axis] = middle;
  }
  extent.center_O = R_O_E * center_E;
  return extent;
}

}  // namespace

Span1d SpanOf(std::vector<double> values) { return SpanWithout(0.005, std::move(values)); }

ObjectExtent ExtentOf(const MovingObject& object) { return ExtentOf(object, {}); }

ObjectExtent ExtentOf(const MovingObject& object, std::span<const PlacedPart> parts) {
  std::vector<PlacedPart> all = {{&object, Pose()}};
  all.insert(all.end(), parts.begin(), parts.end());
  const Footprint footprint = FootprintOf(all);
  if (footprint.outline_O.empty()) return {};
  ObjectExtent best = ExtentAt(footprint, YawOfSmallest(footprint.outline_O));
  constexpr double kPi = std::numbers::pi;
  if (best.size_m.x() < best.size_m.y()) best = ExtentAt(footprint, best.yaw_rad + kPi / 2);
  if (!object.given()) best.size_m = best.size_m.cwiseMax(object.map_O.grid().resolution_m());
  if (object.velocity_O && object.velocity_O->linear.norm() >= kMovingMps) {
    const Eigen::Vector2d length(std::cos(best.yaw_rad), std::sin(best.yaw_rad));
    const bool backwards = length.dot(object.velocity_O->linear.head<2>()) < 0;
    if (backwards) best.yaw_rad += best.yaw_rad > 0 ? -kPi : kPi;
  }
  return best;
}

}  // namespace clearway
