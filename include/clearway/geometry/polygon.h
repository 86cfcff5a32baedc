// Convex polygons in the plane.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace clearway {

using Polygon = std::vector<Eigen::Vector2d>;

// The convex hull, counter-clockwise; fewer than three vertices if the points do not span an area.
// Andrew's monotone chain, "Another efficient algorithm for convex hulls in two dimensions", 1979.
Polygon ConvexOutline(std::vector<Eigen::Vector2d> points);

}  // namespace clearway
