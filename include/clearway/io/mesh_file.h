// Triangle meshes from files.
#pragma once

#include <cstdint>
#include <filesystem>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/shape.h"

namespace clearway {

struct MeshFileOptions {
  double scale = 1;  // of all coordinates, above 0: metres per unit of the file
  // Turn Collada's Z_UP and X_UP files so that y points up, as the problem files of OMPL.app
  // expect.
  bool collada_y_up = false;
  std::uint64_t max_bytes = 256'000'000;
  std::size_t max_triangles = 10'000'000;
  Duration max_time = std::chrono::seconds(60);  // of an import by assimp, by the wall clock
};

// Reads a .ply file itself, and a .stl, .obj, .off, .dae, .gltf or .glb file by assimp, in a child
// process (a fork of this one) that is ended after max_time: a file on which assimp hangs or
// crashes is an error. All meshes of the scene become one, each placed by its nodes' transforms;
// polygons are cut into triangles, equal vertices joined, triangles without area left out.
// Materials, textures and animations are not looked at; a glTF file's buffers must lie in or below
// its folder. A unit that a Collada file declares is applied (without one, its numbers are metres);
// its up-axis is not, unless asked. NOT_FOUND; INVALID_ARGUMENT for another extension, a file that
// cannot be imported, is cut off, does not hold what it states or needs what is not supported
// (docs/formats.md), no triangle with an area, or a coordinate that is not finite;
// RESOURCE_EXHAUSTED above the limits of bytes and triangles, or for want of memory; UNAVAILABLE if
// no process can be started. Any thread.
absl::StatusOr<Mesh> ReadMesh(const std::filesystem::path& path,
                              const MeshFileOptions& options = {});

}  // namespace clearway
