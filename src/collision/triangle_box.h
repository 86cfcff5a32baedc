// A triangle against a box.
#pragma once

#include <Eigen/Core>

#include "collision/oriented_box.h"

namespace clearway {

// The convex hull of three points, which may coincide or lie on a line.
struct Triangle {
  Eigen::Vector3d a, b, c;
};

// Whether they have a point in common, or miss each other by no more than a nanometre. Akenine-
// Moeller, "Fast 3D Triangle-Box Overlap Testing", 2001.
bool Meet(const Triangle& triangle_G, const OrientedBox& box);

// In metres, 0 where they meet, exact to 1e-7 m if at most up_to_m, and above up_to_m beyond that:
// by pairs of features as in Ericson, "Real-Time Collision Detection", 2005, section 5.1.
double Distance(const Triangle& triangle_G, const OrientedBox& box, double up_to_m);

}  // namespace clearway
