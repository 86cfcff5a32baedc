#include "clearway/geometry/shape.h"

#include <cmath>
#include <numbers>

#include "geometry/overloaded.h"

namespace clearway {
namespace {

Aabb Symmetric(const Eigen::Vector3d& half_m) { return {-half_m, half_m}; }

Aabb MeshBox(const Mesh& mesh) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.Extend(vertex);
  return box;
}

// Nothing is inside beyond the mesh's box, in whatever way its pieces wind.
bool WindingContains(const Mesh& mesh, const Eigen::Vector3d& p) {
  if (!MeshBox(mesh).Contains(p)) return false;
  double angle = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    angle += SolidAngle(mesh.vertices[a] - p, mesh.vertices[b] - p, mesh.vertices[c] - p);
  }
  return std::abs(angle) > 2 * std::numbers::pi;  // half of a full turn of 4 pi
}

}  // namespace

Aabb BoundingBox(const Shape& shape) {
  return std::visit(
      Overloaded{
          [](const Sphere& s) { return Symmetric(Eigen::Vector3d::Constant(s.radius_m)); },
          [](const Box& b) { return Symmetric(0.5 * b.size_m); },
          [](const Capsule& c) {
            return Symmetric({c.radius_m, c.radius_m, c.length_m / 2 + c.radius_m});
          },
          [](const Cylinder& c) {
            return Symmetric({c.radius_m, c.radius_m, c.length_m / 2});
          },
          [](const ConvexPolytope& c) { return MeshBox(*c.mesh); },
          [](const TriangleMesh& t) { return MeshBox(*t.mesh); },
      },
      shape);
}

bool Contains(const Shape& shape, const Eigen::Vector3d& p_G) {
  return std::visit(
      Overloaded{
          [&](const Sphere& s) { return p_G.norm() <= s.radius_m; },
          [&](const Box& b) { return (p_G.cwiseAbs().array() <= 0.5 * b.size_m.array()).all(); },
          [&](const Capsule& c) {
            const double above_m = std::max(0.0, std::abs(p_G.z()) - c.length_m / 2);
            return std::hypot(p_G.x(), p_G.y(), above_m) <= c.radius_m;
          },
          [&](const Cylinder& c) {
            return std::hypot(p_G.x(), p_G.y()) <= c.radius_m &&
                   std::abs(p_G.z()) <= c.length_m / 2;
          },
          [&](const ConvexPolytope& c) { return NearHull(*c.mesh, p_G, 0); },
          [&](const TriangleMesh& t) { return WindingContains(*t.mesh, p_G); },
      },
      shape);
}

double SolidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

bool NearHull(const Mesh& hull, const Eigen::Vector3d& p, double margin_m) {
  for (const auto& [a, b, c] : hull.triangles) {
    const Eigen::Vector3d& origin = hull.vertices[a];
    const Eigen::Vector3d normal = (hull.vertices[b] - origin).cross(hull.vertices[c] - origin);
    if (normal.dot(p - origin) > margin_m * normal.norm()) return false;
  }
  return !hull.triangles.empty();
}

}  // namespace clearway
