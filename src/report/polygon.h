// Outlines in the plane.
#pragma once

#include "clearway/geometry/polygon.h"
#include "clearway/scene/moving_object.h"

namespace clearway::report {

// The solid's outline seen from above, with O at T_W_O.
Polygon OutlineOf(const Solid& solid, const Pose& T_W_O);

// The outline of a footprint given in a frame F, with F at T_W_F.
Polygon Moved(const Polygon& polygon_F, const Pose& T_W_F);

}  // namespace clearway::report
