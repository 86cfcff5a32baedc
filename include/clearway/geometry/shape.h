// Shapes as plain data. Each is given in its own frame G, centred at G's origin.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "clearway/geometry/aabb.h"

namespace clearway {

struct Sphere {
  double radius_m = 0;
  bool operator==(const Sphere&) const = default;
};

struct Box {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // full lengths along x, y, z
  bool operator==(const Box&) const = default;
};

// A cylinder along z of the given length with a half sphere at each end.
struct Capsule {
  double radius_m = 0;
  double length_m = 0;  // of the cylindrical part
  bool operator==(const Capsule&) const = default;
};

// Along z.
struct Cylinder {
  double radius_m = 0;
  double length_m = 0;
  bool operator==(const Cylinder&) const = default;
};

// Triangles over shared vertices, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;                // metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices
  bool operator==(const Mesh&) const = default;
};

// Whether both are null or of equal content.
inline bool SameMesh(const std::shared_ptr<const Mesh>& a, const std::shared_ptr<const Mesh>& b) {
  return a == b || (a != nullptr && b != nullptr && *a == *b);
}

// The convex hull of the mesh's vertices; the mesh must be that hull (see ConvexHullOf in hull.h).
struct ConvexPolytope {
  std::shared_ptr<const Mesh> mesh;
  bool operator==(const ConvexPolytope& other) const { return SameMesh(mesh, other.mesh); }
};

// The surface of a mesh and, if it is closed, all that it encloses (see Contains).
struct TriangleMesh {
  std::shared_ptr<const Mesh> mesh;
  bool operator==(const TriangleMesh& other) const { return SameMesh(mesh, other.mesh); }
};

using Shape = std::variant<Sphere, Box, Capsule, Cylinder, ConvexPolytope, TriangleMesh>;

// INVALID_ARGUMENT naming what of `field` is wrong: sizes that are not positive or above 100 m,
// meshes that are empty or whose indices are out of range, hulls that have no volume, are not
// convex or face inward. Takes time in proportion to a hull's triangles times its vertices.
absl::Status Validate(const std::string& field, const Shape& shape);

// The smallest axis-aligned box in G around the shape.
Aabb BoundingBox(const Shape& shape);

// Whether the point lies in the shape (boundary included). A TriangleMesh counts as solid here if
// it is closed: by the winding number, Jacobson et al., "Robust Inside-Outside Segmentation", 2013;
// of an open one, the points in its box that it winds round by more than half.
bool Contains(const Shape& shape, const Eigen::Vector3d& p_G);

// The solid angle of the triangle seen from the origin in steradians, positive if its corners are
// clockwise from there: if the origin is behind it. Van Oosterom and Strackee, 1983.
double SolidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// Whether p lies in the convex hull or at most margin_m from every face's plane that it is outside
// of: true for all points within margin_m of the hull, and for a few more near its edges.
bool NearHull(const Mesh& hull, const Eigen::Vector3d& p, double margin_m);

}  // namespace clearway
