// Shapes as plain data. Each is given in its own frame G, centred at G's origin.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "clearway/geometry/aabb.h"

namespace clearway {

struct Sphere {
  double radius_m = 0;
};

struct Box {
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // full lengths along x, y, z
};

// A cylinder along z of the given length with a half sphere at each end.
struct Capsule {
  double radius_m = 0;
  double length_m = 0;  // of the cylindrical part
};

// Along z.
struct Cylinder {
  double radius_m = 0;
  double length_m = 0;
};

// Triangles over shared vertices, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;                // metres
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices into vertices
};

// The convex hull of the mesh's vertices; the mesh must be that hull (see ConvexHullOf in hull.h).
struct ConvexPolytope {
  std::shared_ptr<const Mesh> mesh;
};

// The surface of a mesh and, if it is closed, all that it encloses (see Contains).
struct TriangleMesh {
  std::shared_ptr<const Mesh> mesh;
};

using Shape = std::variant<Sphere, Box, Capsule, Cylinder, ConvexPolytope, TriangleMesh>;

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
