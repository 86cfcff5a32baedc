#include "collision/turn_bound.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace clearway {
namespace {

// The distance of the box's farthest corner from an axis through its middle.
double FarthestCorner(const Aabb& box_G, const Eigen::Vector3d& axis_G) {
  const Eigen::Vector3d half = 0.5 * box_G.Size();
  double farthest_m = 0;
  for (const double y : {-half.y(), half.y()}) {
    for (const double z : {-half.z(), half.z()}) {
      farthest_m = std::max(farthest_m, Eigen::Vector3d(half.x(), y, z).cross(axis_G).norm());
    }
  }
  return farthest_m;
}

}  // namespace

// A turn by a about the unit vector w moves a point at p from the centre by at most a |w x p|. The
// axis of a cylinder, u, moves by at most a |w x u|, and so does, times its length, what is moved
// by the least turn that puts it there: all other cylinders with that axis are the same.
TurnBound BoundOfTurn(const ShapeGeometry& geometry, const Eigen::Vector3d& axis_G,
                      double axis_off_rad) {
  constexpr double kInLine = 0.01;  // then the cylinder moves far less than its points
  const Shape& shape = geometry.shape();
  if (std::holds_alternative<Sphere>(shape)) return {};
  const double aslant = axis_G.head<2>().norm() + axis_off_rad;  // |w x u|
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    return {.across_m = 0.5 * capsule->length_m * std::min(aslant, 1.0)};
  }
  const double radius_m = 0.5 * geometry.box_G().Size().norm();
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const double longest_m = std::hypot(cylinder->radius_m, 0.5 * cylinder->length_m);
    if (longest_m * aslant < kInLine * cylinder->radius_m) return {.any_m = longest_m * aslant};
    const double across_m = 0.5 * cylinder->length_m * aslant + cylinder->radius_m;
    return {.across_m = std::min(longest_m, across_m)};
  }
  const double across_m = FarthestCorner(geometry.box_G(), axis_G) + axis_off_rad * radius_m;
  return {.across_m = std::min(radius_m, across_m)};
}

}  // namespace clearway
