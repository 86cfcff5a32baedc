#include "clearway/scene/object_extent.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "clearway/geometry/polygon.h"

namespace clearway {
namespace {

// Slower than this, a direction of motion is noise.
constexpr double kMovingMps = 0.5;

// The box around the hull with its length along `yaw_rad`.
ObjectExtent ExtentAt(const Mesh& hull, double yaw_rad) {
  const Eigen::Quaterniond R_O_E(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  Aabb box_E;
  for (const Eigen::Vector3d& p_O : hull.vertices) box_E.Extend(R_O_E.conjugate() * p_O);
  return {yaw_rad, box_E.Size(), R_O_E * box_E.Center()};
}

double AreaOf(const ObjectExtent& extent) { return extent.size_m.x() * extent.size_m.y(); }

// The smallest rectangle lies along an edge of the outline seen from above.
ObjectExtent SmallestExtent(const Mesh& hull) {
  std::vector<Eigen::Vector2d> points_O;
  for (const Eigen::Vector3d& p_O : hull.vertices) points_O.push_back(p_O.head<2>());
  const Polygon outline_O = ConvexOutline(std::move(points_O));
  ObjectExtent best = ExtentAt(hull, 0);
  for (std::size_t i = 0; i < outline_O.size(); ++i) {
    const Eigen::Vector2d edge = outline_O[(i + 1) % outline_O.size()] - outline_O[i];
    const ObjectExtent extent = ExtentAt(hull, std::atan2(edge.y(), edge.x()));
    if (AreaOf(extent) < AreaOf(best)) best = extent;
  }
  return best;
}

}  // namespace

ObjectExtent ExtentOf(const MovingObject& object) {
  const Mesh& hull = *object.solid->hull;
  if (hull.vertices.empty()) return {};
  ObjectExtent best = SmallestExtent(hull);
  constexpr double kPi = std::numbers::pi;
  if (best.size_m.x() < best.size_m.y()) best = ExtentAt(hull, best.yaw_rad + kPi / 2);
  if (object.velocity_O && object.velocity_O->linear.norm() >= kMovingMps) {
    const Eigen::Vector2d length(std::cos(best.yaw_rad), std::sin(best.yaw_rad));
    const bool backwards = length.dot(object.velocity_O->linear.head<2>()) < 0;
    if (backwards) best.yaw_rad += best.yaw_rad > 0 ? -kPi : kPi;
  }
  return best;
}

}  // namespace clearway
