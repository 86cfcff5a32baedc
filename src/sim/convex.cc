#include "sim/convex.h"

#include <Eigen/LU>
#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace clearway {
namespace {

constexpr double kTouchingM = 1e-9;
constexpr int kMaxIterations = 200;

// The point of a convex set that is farthest along a direction.
using Support = std::function<Eigen::Vector3d(const Eigen::Vector3d& direction)>;

Eigen::Vector3d Farthest(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& d) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_height = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& point : points) {
    if (const double height = d.dot(point); height > best_height) {
      best_height = height;
      best = point;
    }
  }
  return best;
}

// A vector of the given length along `v`, or zero.
template <class Vector>
Vector WithLength(const Vector& v, double length) {
  const double norm = v.norm();
  return norm > 0 ? Vector(v * (length / norm)) : Vector(Vector::Zero());
}

Eigen::Vector3d SupportIn(const Sphere& s, const Eigen::Vector3d& d) {
  return WithLength(d, s.radius_m);
}
Eigen::Vector3d SupportIn(const Box& b, const Eigen::Vector3d& d) {
  return (d.array() >= 0).select(0.5 * b.size_m, -0.5 * b.size_m);
}
Eigen::Vector3d SupportIn(const Capsule& c, const Eigen::Vector3d& d) {
  const double end_m = d.z() >= 0 ? c.length_m / 2 : -c.length_m / 2;
  return Eigen::Vector3d(0, 0, end_m) + WithLength(d, c.radius_m);
}
Eigen::Vector3d SupportIn(const Cylinder& c, const Eigen::Vector3d& d) {
  const Eigen::Vector2d side = WithLength(Eigen::Vector2d(d.head<2>()), c.radius_m);
  return {side.x(), side.y(), d.z() >= 0 ? c.length_m / 2 : -c.length_m / 2};
}
Eigen::Vector3d SupportIn(const ConvexPolytope& c, const Eigen::Vector3d& d) {
  return Farthest(c.mesh->vertices, d);
}
Eigen::Vector3d SupportIn(const TriangleMesh& t, const Eigen::Vector3d& d) {
  return Farthest(t.mesh->vertices, d);  // of the hull
}

Support SupportOf(const Shape& shape, const Pose& T_W_G) {
  return [&shape, T_W_G](const Eigen::Vector3d& direction_W) {
    const Eigen::Vector3d direction_G = T_W_G.rotation.conjugate() * direction_W;
    return T_W_G *
           std::visit([&](const auto& kind) { return SupportIn(kind, direction_G); }, shape);
  };
}

// Convex sets that make up the shape's solid, or a mesh's surface.
std::vector<Support> Pieces(const Shape& shape, const Pose& T_W_G) {
  const auto* surface = std::get_if<TriangleMesh>(&shape);
  if (surface == nullptr) return {SupportOf(shape, T_W_G)};
  std::vector<Support> pieces;
  for (const auto& triangle : surface->mesh->triangles) {
    std::vector<Eigen::Vector3d> corners_W;
    for (std::uint32_t vertex : triangle) {
      corners_W.push_back(T_W_G * surface->mesh->vertices[vertex]);
    }
    pieces.push_back([corners_W](const Eigen::Vector3d& d) { return Farthest(corners_W, d); });
  }
  return pieces;
}

// Up to four points of the Minkowski difference.
struct Simplex {
  Eigen::Matrix<double, 3, 4> points = Eigen::Matrix<double, 3, 4>::Zero();
  int size = 0;
};

// The point nearest to the origin of the plane (line, point) through the chosen points, if it lies
// between them.
bool NearestOf(const Simplex& chosen, Eigen::Vector3d& nearest) {
  const int edges = chosen.size - 1;
  nearest = chosen.points.col(0);
  if (edges == 0) return true;
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> E(3, edges);
  for (int i = 0; i < edges; ++i) E.col(i) = chosen.points.col(i + 1) - chosen.points.col(0);
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram = E.transpose() * E;
  const auto lu = gram.fullPivLu();
  if (!lu.isInvertible()) return false;
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> weights =
      lu.solve(-E.transpose() * chosen.points.col(0));
  if ((weights.array() < 0).any() || weights.sum() > 1) return false;
  nearest += E * weights;
  return true;
}

// The simplex' point nearest to the origin; reduces the simplex to the points it lies between.
Eigen::Vector3d Reduce(Simplex& simplex) {
  Simplex best;
  Eigen::Vector3d best_point = Eigen::Vector3d::Zero();
  double best_squared = std::numeric_limits<double>::infinity();
  for (int mask = 1; mask < 1 << simplex.size; ++mask) {
    Simplex chosen;
    for (int i = 0; i < simplex.size; ++i) {
      if (mask >> i & 1) chosen.points.col(chosen.size++) = simplex.points.col(i);
    }
    Eigen::Vector3d point;
    if (NearestOf(chosen, point) && point.squaredNorm() < best_squared) {
      best_squared = point.squaredNorm();
      best = chosen;
      best_point = point;
    }
  }
  simplex = best;
  return best_point;
}

bool Touch(const Support& a, const Support& b) {
  Simplex simplex;
  Eigen::Vector3d nearest = a(Eigen::Vector3d::UnitX()) - b(-Eigen::Vector3d::UnitX());
  simplex.points.col(simplex.size++) = nearest;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (nearest.norm() <= kTouchingM || simplex.size == 4) return true;
    const Eigen::Vector3d point = a(-nearest) - b(nearest);
    const double reach = nearest.dot(point) / nearest.norm();
    if (reach > kTouchingM) return false;  // `nearest` is a separating axis
    simplex.points.col(simplex.size++) = point;
    nearest = Reduce(simplex);
  }
  return nearest.norm() <= 1e-6;  // rounding went round in circles at a grazing contact
}

bool Inside(const Shape& outer, const Pose& T_W_A, const Shape& inner, const Pose& T_W_B) {
  if (!std::holds_alternative<TriangleMesh>(outer)) return false;  // its pieces are solid
  const Eigen::Vector3d p_W = SupportOf(inner, T_W_B)(Eigen::Vector3d::UnitX());
  return Contains(outer, Inverse(T_W_A) * p_W);
}

}  // namespace

bool Touch(const Shape& a, const Pose& T_W_A, const Shape& b, const Pose& T_W_B) {
  const std::vector<Support> pieces_a = Pieces(a, T_W_A);
  const std::vector<Support> pieces_b = Pieces(b, T_W_B);
  for (const Support& piece_a : pieces_a) {
    for (const Support& piece_b : pieces_b) {
      if (Touch(piece_a, piece_b)) return true;
    }
  }
  return Inside(a, T_W_A, b, T_W_B) || Inside(b, T_W_B, a, T_W_A);
}

}  // namespace clearway
