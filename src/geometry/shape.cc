#include "clearway/geometry/shape.h"

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

Aabb Symmetric(const Eigen::Vector3d& half_m) { return {-half_m, half_m}; }

Aabb MeshBox(const Mesh& mesh) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.Extend(vertex);
  return box;
}

// The solid angle of a triangle seen from p; Van Oosterom and Strackee, 1983.
double SolidAngle(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle,
                  const Eigen::Vector3d& p) {
  const Eigen::Vector3d a = mesh.vertices[triangle[0]] - p;
  const Eigen::Vector3d b = mesh.vertices[triangle[1]] - p;
  const Eigen::Vector3d c = mesh.vertices[triangle[2]] - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

bool WindingContains(const Mesh& mesh, const Eigen::Vector3d& p) {
  double angle = 0;
  for (const auto& triangle : mesh.triangles) angle += SolidAngle(mesh, triangle, p);
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

bool NearHull(const Mesh& hull, const Eigen::Vector3d& p, double margin_m) {
  for (const auto& [a, b, c] : hull.triangles) {
    const Eigen::Vector3d& origin = hull.vertices[a];
    const Eigen::Vector3d normal = (hull.vertices[b] - origin).cross(hull.vertices[c] - origin);
    if (normal.dot(p - origin) > margin_m * normal.norm()) return false;
  }
  return !hull.triangles.empty();
}

}  // namespace clearway
