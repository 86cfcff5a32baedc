#include "cli/robot_notes.h"

namespace clearway::cli {

void PrintRobotNotes(const Robot& robot, std::ostream& err) {
  for (const auto& note : WithSolidMeshes(robot).notes) err << "note: robot." << note << "\n";
}

}  // namespace clearway::cli
