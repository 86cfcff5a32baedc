// How things move in a simulated world: poses as exact functions of time.
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// Stands still.
struct FixedPose {
  Pose T_W_B = {};
};

// A constant body velocity (rad/s and m/s in B, at B's origin), for ever: a screw.
struct ConstantTwist {
  Pose T_W_B = {};  // at `at`
  Twist velocity_B = {};
  Time at = {};
};

// Passes through poses, along a constant screw between two of them. A stop is the same pose twice;
// before the first and after the last it stands still.
struct WaypointPath {
  struct Point {
    Time time;
    Pose T_W_B;
  };
  std::vector<Point> points = {};  // ascending times; less than half a turn apart
};

// Drives like a vehicle in the plane of B's x and y axes: x forward, on circular arcs, with
// constant acceleration on each leg, so that its speed is continuous. Before the start it comes
// straight at the start speed; after the last leg it goes straight on at the last speed.
struct Drive {
  struct Leg {
    Duration duration;         // above zero
    double end_speed_mps = 0;  // of the leg; negative is backwards
    double turn_rad = 0;       // to the left over the leg, spread evenly over its length; a leg of
                               // no length turns on the spot
  };
  Pose T_W_B = {};  // at `start`
  double start_speed_mps = 0;
  std::vector<Leg> legs = {};
  Time start = {};
};

// Swings about the x axis of its pivot frame P: by angle amplitude * sin(2 pi (t - at) / period),
// with B's origin length_m below P's origin along P's z axis at angle 0. With length 0 it turns to
// and fro.
struct Pendulum {
  Pose T_W_P = {};
  double length_m = 0;
  double amplitude_rad = 0;
  Duration period;  // above zero
  Time at = {};
};

using Trajectory = std::variant<FixedPose, ConstantTwist, WaypointPath, Drive, Pendulum>;

// T_W_B at time t, for every t; within a few 1e-12 of exact in the poses' range of a kilometre.
Pose PoseAt(const Trajectory& trajectory, Time t);

// Length of the path that `drive` has covered at the end of its last leg, in metres.
double LengthOf(const Drive& drive);

}  // namespace clearway
