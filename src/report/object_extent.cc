#include "clearway/report/object_extent.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "report/polygon.h"

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

// The direction of the outline's edge that the smallest rectangle lies along.
ObjectExtent SmallestExtent(const Mesh& hull, const report::Polygon& outline) {
  ObjectExtent best = ExtentAt(hull, 0);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    const ObjectExtent extent = ExtentAt(hull, std::atan2(edge.y(), edge.x()));
    if (AreaOf(extent) < AreaOf(best)) best = extent;
  }
  return best;
}

// Turned by whole quarters so that its length points nearest to `yaw_rad`.
ObjectExtent TurnedTo(const Mesh& hull, const ObjectExtent& extent, double yaw_rad) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const double quarters = std::round((yaw_rad - extent.yaw_rad) / kQuarter);
  return ExtentAt(hull, extent.yaw_rad + quarters * kQuarter);
}

}  // namespace

ObjectExtent ExtentOf(const MovingObject& object) {
  const Mesh& hull = *object.solid->hull;
  if (hull.vertices.empty()) return {};
  const ObjectExtent best = SmallestExtent(hull, report::OutlineOf(*object.solid, Pose{}));
  if (object.velocity_O && object.velocity_O->linear.head<2>().norm() >= kMovingMps) {
    const Eigen::Vector3d v = object.velocity_O->linear;
    return TurnedTo(hull, best, std::atan2(v.y(), v.x()));
  }
  const bool lengthwise = best.size_m.x() >= best.size_m.y();
  return lengthwise ? best : ExtentAt(hull, best.yaw_rad + std::numbers::pi / 2);
}

}  // namespace clearway
