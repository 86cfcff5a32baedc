// Whether points are those of an object where it is predicted.
#pragma once

#include <Eigen/Core>
#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// How points lie to the box of an object's occupied voxels, or to its placed_box_O.
struct GateOffset {
  // See OffsetFrom. Without what is less than two voxels along an axis, and with it.
  Eigen::Vector3d off_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d exact_off_W = Eigen::Vector3d::Zero();
  // Half of the box's extent in that direction, or that of the points if it is less.
  double half_size_m = 0;
  // By how much the points spread farther than the box, along the axis where it is most.
  double wider_m = 0;
};

// The shortest translation of the object at T_W_O, along O's axes, after which its box holds the
// points or, along an axis where they spread farther than it, they hold the box. The outermost
// twentieth of many points on each side is left out: strays.
GateOffset OffsetFrom(const MovingObject& object, const Pose& T_W_O,
                      std::span<const Eigen::Vector3d> points_W);

// Whether points that are off by that can be the object's: by no more than the 95 % bound of where
// it is and half its size.
bool MeetsPrediction(const GateOffset& offset, double bound_m);

// The box, as large as the points along each axis where they hold it: a view of more of the object.
Aabb GrownByView(const Aabb& box_O, std::span<const Eigen::Vector3d> points_O);

}  // namespace clearway
