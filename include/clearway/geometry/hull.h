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

}  // namespace clearway
