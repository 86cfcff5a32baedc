// Meshes out of PLY files.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "clearway/geometry/shape.h"
#include "clearway/io/mesh_file.h"

namespace clearway {

// Reads the vertices (x, y, z) and faces (a list vertex_indices or vertex_index) of a PLY file, and
// passes over its other properties and elements. Errors begin with `name` and say which line,
// vertex or face is wrong, what is stated and what is found. INVALID_ARGUMENT for a file that holds
// less or more than its header states, has no faces or faces in another element (tristrips), and
// for faces that name vertices that are not there, have more than 10,000 corners or cross
// themselves; RESOURCE_EXHAUSTED above max_triangles, or three times as many vertices. Any thread.
absl::StatusOr<Mesh> ReadPlyMesh(const std::string& name, std::string_view bytes,
                                 const MeshFileOptions& options);

}  // namespace clearway
