// A robot's path through space and time.
#pragma once

#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// Where a robot's frame R is at a time. A value.
struct TimedPose {
  Time time;
  Pose T_W_R;
};

}  // namespace clearway
