#include "sim/ray_shape.h"

#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

constexpr RayInterval kMiss{kNoHit, -kNoHit};

RayInterval Both(const RayInterval& a, const RayInterval& b) {
  return {std::max(a.enter, b.enter), std::min(a.leave, b.leave)};
}

// The smallest interval around two; for convex sets whose union is convex.
RayInterval Either(const RayInterval& a, const RayInterval& b) {
  if (a.enter > a.leave) return b;
  if (b.enter > b.leave) return a;
  return {std::min(a.enter, b.enter), std::max(a.leave, b.leave)};
}

// Where |value at distance 0 + slope * distance| <= half.
RayInterval InSlab(double value, double slope, double half) {
  if (slope == 0) return std::abs(value) <= half ? RayInterval{} : kMiss;
  const double a = (-half - value) / slope;
  const double b = (half - value) / slope;
  return {std::min(a, b), std::max(a, b)};
}

// Solutions of a x^2 + 2 b x + c <= 0, a > 0.
RayInterval Below(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kMiss;
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

RayInterval InBall(double radius_m, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  return Below(d.squaredNorm(), o.dot(d), o.squaredNorm() - radius_m * radius_m);
}

RayInterval InTube(double radius_m, double length_m, const Eigen::Vector3d& o,
                   const Eigen::Vector3d& d) {
  const double a = d.head<2>().squaredNorm();
  const double c = o.head<2>().squaredNorm() - radius_m * radius_m;
  const RayInterval side =
      a > 0 ? Below(a, o.head<2>().dot(d.head<2>()), c) : (c <= 0 ? RayInterval{} : kMiss);
  return Both(side, InSlab(o.z(), d.z(), length_m / 2));
}

RayInterval In(const Sphere& s, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  return InBall(s.radius_m, o, d);
}

RayInterval In(const Box& b, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  return IntervalInBox({-0.5 * b.size_m, 0.5 * b.size_m}, o, d);
}

RayInterval In(const Capsule& c, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  const Eigen::Vector3d up(0, 0, c.length_m / 2);
  return Either(InTube(c.radius_m, c.length_m, o, d),
                Either(InBall(c.radius_m, o - up, d), InBall(c.radius_m, o + up, d)));
}

RayInterval In(const Cylinder& c, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  return InTube(c.radius_m, c.length_m, o, d);
}

RayInterval In(const ConvexPolytope& c, const Eigen::Vector3d& o, const Eigen::Vector3d& d) {
  RayInterval inside;
  for (const auto& [ia, ib, ic] : c.mesh->triangles) {
    const Eigen::Vector3d& a = c.mesh->vertices[ia];
    const Eigen::Vector3d normal = (c.mesh->vertices[ib] - a).cross(c.mesh->vertices[ic] - a);
    const double height = normal.dot(o - a);
    const double slope = normal.dot(d);
    if (slope < 0) {
      inside.enter = std::max(inside.enter, -height / slope);
    } else if (slope > 0) {
      inside.leave = std::min(inside.leave, -height / slope);
    } else if (height > 0) {
      return kMiss;
    }
  }
  return c.mesh->triangles.empty() ? kMiss : inside;
}

RayInterval In(const TriangleMesh&, const Eigen::Vector3d&, const Eigen::Vector3d&) {
  return kMiss;
}

}  // namespace

RayInterval IntervalInBox(const Aabb& box_G, const Eigen::Vector3d& origin_G,
                          const Eigen::Vector3d& direction_G) {
  RayInterval inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = 0.5 * (box_G.min[axis] + box_G.max[axis]);
    const double half = 0.5 * (box_G.max[axis] - box_G.min[axis]);
    inside = Both(inside, InSlab(origin_G[axis] - center, direction_G[axis], half));
  }
  return inside;
}

double RayDistance(const Shape& shape, const Eigen::Vector3d& origin_G,
                   const Eigen::Vector3d& direction_G) {
  const RayInterval inside =
      std::visit([&](const auto& kind) { return In(kind, origin_G, direction_G); }, shape);
  if (inside.enter > inside.leave || inside.leave < 0) return kNoHit;
  return inside.enter >= 0 ? inside.enter : inside.leave;
}

double RayDistanceToTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) {
  // Neighbouring triangles overlap by this much of their size, so that no ray slips between them.
  constexpr double kOverlap = 1e-12;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return kNoHit;
  const Eigen::Vector3d ao = origin - a;
  const double u = ao.dot(p) / determinant;
  if (u < -kOverlap || u > 1 + kOverlap) return kNoHit;
  const Eigen::Vector3d q = ao.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (v < -kOverlap || u + v > 1 + kOverlap) return kNoHit;
  const double distance = ac.dot(q) / determinant;
  return distance >= 0 ? distance : kNoHit;
}

}  // namespace clearway
