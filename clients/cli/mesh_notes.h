// What a user has to know of the meshes of a robot or of objects: one line for each that is not
// used as its file gives it, since faces were turned, doubled ones dropped, holes closed, or its
// convex hull replaces it.
#pragma once

#include <ostream>
#include <span>

#include "clearway/collision/robot.h"
#include "clearway/scene/given_object.h"

namespace clearway::cli {

// The robot must be valid.
void PrintRobotNotes(const Robot& robot, std::ostream& err);

// Named by their ids. Meshes that are not valid are not looked at.
void PrintObjectNotes(std::span<const GivenObject> objects, std::ostream& err);

}  // namespace clearway::cli
