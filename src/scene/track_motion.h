// How an object goes on, by the poses it had.
#pragma once

#include <Eigen/Core>
#include <span>

#include "clearway/scene/moving_object.h"

namespace clearway {

// The velocity of the constant screw that fits the poses of about the last second (MotionModel::
// kTrack), at O's origin; by ascending stamp, two or more. center_O is the middle of the object:
// what is noise of its turns is felt least there. Poses that lie on one constant screw give that;
// where there are fewer than three in that time, or it turned too far, the last two give their
// VelocityBetween. An object that stands still, up to rounding, has none.
//
// Weighted least squares, later poses counting more. What turns is taken to keep its rate. Along
// its way the object may be gaining or losing speed, evenly: a screw cannot, so it gets the speed
// that is expected half a second later, and meets such an object again a second ahead. One that
// brakes stops, and does not come back. Along the vertical (W's z) speeds are steady.
Twist VelocityOfTrack(std::span<const StampedPose> track, const Eigen::Vector3d& center_O);

}  // namespace clearway
