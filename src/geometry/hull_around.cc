#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "clearway/geometry/hull.h"

namespace clearway {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// What a polytope that was made to touch the shape gets in size, so that rounding does not bring it
// inside.
constexpr double kGrownBy = 1 + 1e-9;

// The corners of a polytope that holds the unit ball, by less than 1 %: an icosahedron's faces cut
// into triangles, their corners put on a sphere, and that grown until the faces touch the ball.
Points PointsAroundUnitBall() {
  constexpr int kCuts = 6;  // of an icosahedron's edge: 362 corners, 0.9 % larger
  const double golden = std::numbers::phi;
  Points corners;
  for (const double one : {-1.0, 1.0}) {
    for (const double phi : {-golden, golden}) {
      corners.insert(corners.end(), {{0, one, phi}, {one, phi, 0}, {phi, 0, one}});
    }
  }
  const Mesh icosahedron = ConvexHullOf(corners);
  Points points;
  for (const auto& [a, b, c] : icosahedron.triangles) {
    for (int i = 0; i <= kCuts; ++i) {
      for (int j = 0; i + j <= kCuts; ++j) {
        const Eigen::Vector3d point = i * icosahedron.vertices[a] + j * icosahedron.vertices[b] +
                                      (kCuts - i - j) * icosahedron.vertices[c];
        points.push_back(point.normalized());
      }
    }
  }
  // Those on an edge come from both of its faces, apart by rounding at most.
  Points once;
  for (const Eigen::Vector3d& point : points) {
    const auto same = [&](const Eigen::Vector3d& p) { return (p - point).norm() < 1e-6; };
    if (std::none_of(once.begin(), once.end(), same)) once.push_back(point);
  }
  const Mesh mesh = ConvexHullOf(once);
  double nearest = 1;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& corner = mesh.vertices[a];
    const Eigen::Vector3d normal = (mesh.vertices[b] - corner).cross(mesh.vertices[c] - corner);
    nearest = std::min(nearest, normal.normalized().dot(corner));
  }
  for (Eigen::Vector3d& point : once) point *= kGrownBy / nearest;
  return once;
}

const Points& AroundUnitBall() {
  static const Points& points = *new Points(PointsAroundUnitBall());
  return points;
}

struct PointsAround {
  Points operator()(const Sphere& s) const {
    Points points = AroundUnitBall();
    for (Eigen::Vector3d& point : points) point *= s.radius_m;
    return points;
  }
  Points operator()(const Box& b) const {
    Points points;
    for (int corner = 0; corner < 8; ++corner) {
      points.push_back(0.5 * b.size_m.cwiseProduct(Eigen::Vector3d(
                                 corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
    }
    return points;
  }
  // A polytope around the ball, carried along the axis.
  Points operator()(const Capsule& c) const {
    Points points;
    const Eigen::Vector3d end(0, 0, c.length_m / 2);
    for (const Eigen::Vector3d& point : AroundUnitBall()) {
      points.push_back(c.radius_m * point + end);
      points.push_back(c.radius_m * point - end);
    }
    return points;
  }
  // A prism whose sides touch the cylinder.
  Points operator()(const Cylinder& c) const {
    constexpr int kSides = 24;  // 0.9 % larger
    Points points;
    for (int side = 0; side < kSides; ++side) {
      const double angle_rad = 2 * std::numbers::pi * side / kSides;
      const double radius_m = kGrownBy * c.radius_m / std::cos(std::numbers::pi / kSides);
      for (const double z_m : {-c.length_m / 2, c.length_m / 2}) {
        points.emplace_back(radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m);
      }
    }
    return points;
  }
  Points operator()(const ConvexPolytope& p) const { return p.mesh->vertices; }
  Points operator()(const TriangleMesh& t) const { return t.mesh->vertices; }
};

}  // namespace

Mesh HullAround(const Shape& shape) { return ConvexHullOf(std::visit(PointsAround{}, shape)); }

}  // namespace clearway
