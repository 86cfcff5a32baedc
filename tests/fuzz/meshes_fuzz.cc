// Meshes. The first line is the file's extension, as in ".stl". What assimp reads is imported in a
// child process when it comes from a user; here are our own readers: of PLY, and of what files of
// the other kinds state.
#include <memory>

#include "clearway/geometry/mesh_validation.h"
#include "clearway/geometry/solid_mesh.h"
#include "clearway/io/mesh_file.h"
#include "fuzz/fuzz.h"
#include "io/mesh_bytes.h"
#include "io/mesh_content.h"
#include "io/ply_mesh.h"

namespace clearway::fuzz {
namespace {

constexpr std::size_t kMaxTriangles = 10'000;
constexpr std::size_t kMaxSolid = 200;  // triangles that are made a solid, which takes long

void RequireWhole(const Mesh& mesh) {
  Require(mesh.triangles.size() <= kMaxTriangles, "more triangles than may be");
  for (const auto& triangle : mesh.triangles) {
    for (const auto index : triangle) Require(index < mesh.vertices.size(), "no such vertex");
  }
  for (const auto& vertex : mesh.vertices) Require(vertex.allFinite(), "a vertex is not finite");
}

void RunPly(std::string_view bytes) {
  const auto mesh = ReadPlyMesh("mesh", bytes, {.max_triangles = kMaxTriangles});
  RequireForeseen(mesh.status());
  if (!mesh.ok()) return;
  RequireWhole(*mesh);
  const auto again = MeshFromBytes(MeshToBytes(*mesh));
  Require(again.ok() && *again == *mesh, "a mesh changes on its way to another process");
  const auto shared = std::make_shared<const Mesh>(*mesh);
  if (mesh->triangles.size() > kMaxSolid || !ValidateMesh("mesh", shared).ok()) return;
  RequireWhole(*SolidMeshOf(shared).mesh);
}

void Run(std::string_view input) {
  const std::string extension(TakeLine(input));
  if (extension == ".ply") return RunPly(input);
  if (extension.empty()) return RequireForeseen(MeshFromBytes(input).status());
  for (const char* known : {".stl", ".obj", ".off", ".dae", ".gltf", ".glb"}) {
    if (extension == known) RequireForeseen(CheckMeshContent(extension, input).status());
  }
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
