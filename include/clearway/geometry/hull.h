// Convex hulls.
#pragma once

#include <Eigen/Core>
#include <span>

#include "clearway/geometry/shape.h"

namespace clearway {

// The convex hull of the points, triangles counter-clockwise seen from outside, vertices in the
// points' order. The result is empty if the points do not span a volume. Computed by Qhull,
// http://www.qhull.org.
Mesh ConvexHullOf(std::span<const Eigen::Vector3d> points);

// A convex polytope that holds the shape (of a mesh: its vertices), in G. It is the shape's convex
// hull where that is a polytope; about a round shape it is circumscribed, and no point of it is
// farther than 1 % of the radius from the shape.
Mesh HullAround(const Shape& shape);

}  // namespace clearway
