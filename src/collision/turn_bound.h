// By how much a turn about its centre moves a shape.
#pragma once

#include <Eigen/Core>

#include "collision/narrowphase.h"
#include "collision/spread.h"

namespace clearway {

// In metres a radian, at most. What is moved lies in the shape (in its core, if that is rounded) as
// it was, grown by a disc across the axis of the turn and by a ball: points go across the axis
// alone; a cylinder that turns about its own axis stays what it is, and one that is nearly in line
// with it moves less than its points. A plain value.
struct TurnBound {
  double across_m = 0;  // radius of the disc
  double any_m = 0;     // radius of the ball
  double larger_m() const { return across_m + any_m; }
};

// The center is that of the shape's box, the axis of length 1 or 0 in the shape's frame, and
// uncertain by so many radians.
TurnBound BoundOfTurn(const ShapeGeometry& geometry, const Eigen::Vector3d& axis_G,
                      double axis_off_rad = 0);

}  // namespace clearway
