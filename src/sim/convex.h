// Contact of shapes, for ground truth: independent of the collision layer.
#pragma once

#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// Whether the two shapes touch; triangle meshes count with their inside. By the distance algorithm
// of Gilbert, Johnson, Keerthi, "A Fast Procedure for Computing the Distance Between Complex
// Objects in Three-Dimensional Space", 1988, on each pair of convex pieces.
bool Touch(const Shape& a, const Pose& T_W_A, const Shape& b, const Pose& T_W_B);

}  // namespace clearway
