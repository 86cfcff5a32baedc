// Outlines in the plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/scene/moving_object.h"

namespace clearway::report {

using Polygon = std::vector<Eigen::Vector2d>;

// The convex hull, counter-clockwise; fewer than three vertices if the points do not span an area.
// Andrew's monotone chain, "Another efficient algorithm for convex hulls in two dimensions", 1979.
Polygon ConvexOutline(std::vector<Eigen::Vector2d> points);

// The solid's outline seen from above, with O at T_W_O.
Polygon OutlineOf(const Solid& solid, const Pose& T_W_O);

// The outline of a footprint given in a frame F, with F at T_W_F.
Polygon Moved(const Polygon& polygon_F, const Pose& T_W_F);

}  // namespace clearway::report
