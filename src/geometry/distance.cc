#include "clearway/geometry/distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/overloaded.h"

namespace clearway {
namespace {

// From p to the box's nearest point, with the sign of p's side.
Eigen::Vector3d Outside(const Eigen::Vector3d& p, const Aabb& box) {
  return (p - box.max).cwiseMax(0.0) + (p - box.min).cwiseMin(0.0);
}

// Where the products of Ericson's form lose more digits than the squared sine of an angle has.
constexpr double kSliver = 1e-8;

// Of a triangle so thin that its plane counts only if it is known, and then by cross products.
double PointSliverDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                           const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double to_rim_m = std::min({PointSegmentDistance(p, a, b), PointSegmentDistance(p, b, c),
                                    PointSegmentDistance(p, c, a)});
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
  const Eigen::Vector3d normal = ab.cross(ac);
  if (normal.squaredNorm() <= kSliver * kSliver * ab.squaredNorm() * ac.squaredNorm()) {
    return to_rim_m;
  }
  const bool above = normal.dot(ab.cross(ap)) >= 0 && normal.dot((c - b).cross(p - b)) >= 0 &&
                     normal.dot(ap.cross(ac)) >= 0;
  return above ? std::min(to_rim_m, std::abs(normal.dot(ap)) / normal.norm()) : to_rim_m;
}

double PointMeshDistance(const Eigen::Vector3d& p, const Mesh& mesh) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    nearest_m = std::min(
        nearest_m, PointTriangleDistance(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  }
  return nearest_m;
}

}  // namespace

double BoxBoxDistance(const Aabb& a, const Aabb& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0).norm();
}

double PointBoxDistance(const Eigen::Vector3d& p, const Aabb& box) {
  return Outside(p, box).norm();
}

// The squared distance along the segment is convex, and its derivative is piecewise linear in the
// parameter with kinks only where the segment crosses a face's plane: so the minimum is found
// exactly by looking at the kinks in order and interpolating where the derivative changes sign.
double SegmentBoxDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Aabb& box) {
  const Eigen::Vector3d along = b - a;
  const auto slope = [&](double s) { return along.dot(Outside(a + s * along, box)); };
  std::array<double, 7> kinks;
  kinks.fill(1);  // the last one, and those that lie off the segment
  std::size_t count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (double plane : {box.min[axis], box.max[axis]}) {
      const double s = (plane - a[axis]) / along[axis];
      if (s > 0 && s < 1) kinks[count++] = s;  // false for NaN
    }
  }
  std::sort(kinks.begin(), kinks.end());
  double s = 0, slope_s = slope(0);
  for (double next : kinks) {
    if (slope_s >= 0) break;
    const double slope_next = slope(next);
    s = slope_next > 0 ? s + (next - s) * slope_s / (slope_s - slope_next) : next;
    slope_s = slope_next;
  }
  return PointBoxDistance(a + s * along, box);
}

double PointSegmentDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b) {
  const Eigen::Vector3d ab = b - a, ap = p - a;
  const double along = ab.dot(ap), all = ab.squaredNorm();
  if (along <= 0) return ap.norm();
  return along >= all ? (p - b).norm() : (ap - along / all * ab).norm();
}

double PointTriangleDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return (ap - d1 / (d1 - d3) * ab).norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  }
  const Eigen::Vector3d normal = ab.cross(ac);
  if (normal.squaredNorm() <= kSliver * ab.squaredNorm() * ac.squaredNorm()) {
    return PointSliverDistance(p, a, b, c);
  }
  return std::abs(normal.dot(ap)) / normal.norm();
}

Eigen::Vector3d NearestPoint(const Eigen::Vector3d& p, const Cylinder& cylinder) {
  const double out_m = std::hypot(p.x(), p.y()), half_m = 0.5 * cylinder.length_m;
  const double inward = out_m <= cylinder.radius_m ? 1 : cylinder.radius_m / out_m;
  return {p.x() * inward, p.y() * inward, std::clamp(p.z(), -half_m, half_m)};
}

double DepthIn(const Shape& shape, const Eigen::Vector3d& p) {
  return std::visit(Overloaded{
                        [&](const Sphere& s) { return s.radius_m - p.norm(); },
                        [&](const Box& b) { return (0.5 * b.size_m - p.cwiseAbs()).minCoeff(); },
                        [&](const Capsule& c) {
                          const double above_m = std::max(0.0, std::abs(p.z()) - c.length_m / 2);
                          return c.radius_m - std::hypot(p.x(), p.y(), above_m);
                        },
                        [&](const Cylinder& c) {
                          return std::min(c.radius_m - std::hypot(p.x(), p.y()),
                                          c.length_m / 2 - std::abs(p.z()));
                        },
                        [](const auto&) { return -1.0; },
                    },
                    shape);
}

double PointShapeDistance(const Eigen::Vector3d& p, const Shape& shape) {
  return std::visit(Overloaded{
                        [&](const Sphere& s) { return std::max(0.0, p.norm() - s.radius_m); },
                        [&](const Box&) { return PointBoxDistance(p, BoundingBox(shape)); },
                        [&](const Capsule& c) {
                          const double above_m = std::max(0.0, std::abs(p.z()) - c.length_m / 2);
                          return std::max(0.0, std::hypot(p.x(), p.y(), above_m) - c.radius_m);
                        },
                        [&](const Cylinder& c) {
                          const double above_m = std::max(0.0, std::abs(p.z()) - c.length_m / 2);
                          return std::hypot(std::max(0.0, std::hypot(p.x(), p.y()) - c.radius_m),
                                            above_m);
                        },
                        [&](const auto& with_mesh) {
                          return Contains(shape, p) ? 0.0 : PointMeshDistance(p, *with_mesh.mesh);
                        },
                    },
                    shape);
}

double SurfaceDistance(const Eigen::Vector3d& p, const Shape& shape) {
  const auto of_mesh = [&](const auto& with_mesh) { return PointMeshDistance(p, *with_mesh.mesh); };
  const auto of_solid = [&](const auto&) {
    const double depth_m = DepthIn(shape, p);
    return depth_m > 0 ? depth_m : PointShapeDistance(p, shape);
  };
  return std::visit(Overloaded{
                        [&](const ConvexPolytope& polytope) { return of_mesh(polytope); },
                        [&](const TriangleMesh& mesh) { return of_mesh(mesh); },
                        of_solid,
                    },
                    shape);
}

}  // namespace clearway
