// What the beams of a sparse sensor leave out of an object.
#pragma once

#include <Eigen/Core>

#include "clearway/scene/moving_object.h"

namespace clearway {

// Of an object's heights (layers of voxels across z of O, from the lowest that was hit to the
// highest), the share that was not hit yet, if it is as with beams that are wide apart: seen from
// the sensor (in W), the layers that were hit are more than half a degree from one to the next. 0
// with denser beams, for far objects as well.
double ShareMissedBetweenBeams(const MovingObject& object, const Eigen::Vector3d& sensor_W);

}  // namespace clearway
