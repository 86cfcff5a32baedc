#include "cli/mesh_notes.h"

#include "clearway/geometry/solid_mesh.h"

namespace clearway::cli {

void PrintRobotNotes(const Robot& robot, std::ostream& err) {
  for (const auto& note : WithSolidMeshes(robot).notes) err << "note: robot." << note << "\n";
}

void PrintObjectNotes(std::span<const GivenObject> objects, std::ostream& err) {
  for (const GivenObject& object : objects) {
    const auto* triangles = std::get_if<TriangleMesh>(&object.shape);
    if (triangles == nullptr || !Validate("mesh", object.shape).ok()) continue;
    const SolidMesh solid = SolidMeshOf(triangles->mesh);
    if (solid.note.empty()) continue;
    err << "note: mesh of object " << object.id << ": " << solid.note << "\n";
  }
}

}  // namespace clearway::cli
