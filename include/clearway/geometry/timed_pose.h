// A step of a path through space and time.
#pragma once

#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// Where a robot's link is at a time. A value.
struct TimedPose {
  Time time;
  Pose T_W_L;
};

}  // namespace clearway
