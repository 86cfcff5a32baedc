// Meshes by assimp.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/geometry/shape.h"
#include "clearway/io/mesh_file.h"

namespace clearway {

// Checks what the file states (mesh_content.h) and imports it by the importer of its extension (in
// lower case: ".stl"). `bytes` are those of the file; its path tells where its buffers are. Both
// the check and assimp may hang, crash or use up memory when a file is made to that end: this is to
// be called in a child process (guarded_call.h). Errors do not name the file. INVALID_ARGUMENT and
// RESOURCE_EXHAUSTED as ReadMesh.
absl::StatusOr<Mesh> ImportByAssimp(const std::filesystem::path& path, const std::string& extension,
                                    const std::string& bytes, const MeshFileOptions& options);

}  // namespace clearway
