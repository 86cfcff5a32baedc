// Meshes as bytes, from one process of a program to another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// The numbers of vertices and of triangles (uint64), then the vertices (three doubles each) and the
// triangles (three uint32), all in the machine's byte order.
std::string MeshToBytes(const Mesh& mesh);

// INVALID_ARGUMENT unless the bytes are one whole mesh, of finite coordinates, whose triangles name
// vertices that are there.
absl::StatusOr<Mesh> MeshFromBytes(std::string_view bytes);

// As many as a mesh of that many triangles can have: three vertices each.
std::uint64_t MaxMeshBytes(std::size_t max_triangles);

}  // namespace clearway
