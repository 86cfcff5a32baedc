// What a user has to know of a robot's meshes.
#pragma once

#include <ostream>

#include "clearway/collision/robot.h"

namespace clearway::cli {

// One line for each mesh that is not checked as its file gives it: faces were turned, doubled ones
// dropped, or its convex hull replaces it. The robot must be valid.
void PrintRobotNotes(const Robot& robot, std::ostream& err);

}  // namespace clearway::cli
