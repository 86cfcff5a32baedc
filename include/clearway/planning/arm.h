// Arms of revolute joints.
#pragma once

#include "clearway/collision/plan_task.h"
#include "clearway/planning/state_mapping.h"

namespace clearway {

// For states of an R^n with one axis for each joint. The robot must have one link more than the arm
// has joints.
//
// On a straight way in joint space each point of a link goes on a curve. How far that strays from
// where the link goes if it moves straight and turns evenly between the ends follows from the
// joints' angles and the points' distances from their axes: about the square of the angle.
StateMapping ArmMapping(const Robot& robot, const ArmSpace& arm, TimeSource time);

}  // namespace clearway
