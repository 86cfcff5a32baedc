// Whether a mesh file holds all that it promises, and what of it assimp is to read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/geometry/aabb.h"

namespace clearway {

// How many faces of three corners or more a file holds; none where it does not say.
using FaceCount = std::optional<std::uint64_t>;

// A mesh that assimp must find.
struct MeshPart {
  std::string name;  // which assimp gives it: its place in the file
  std::uint64_t faces = 0;
  std::optional<Aabb> bounds;  // of its vertices in its own frame, as the file states them
};

struct MeshContent {
  FaceCount faces;
  std::vector<MeshPart> parts;         // empty where the check has read all references itself
  std::vector<std::string> buffers;    // files beside it that hold numbers
  std::optional<std::string> reduced;  // what assimp is to read instead of the file
};

// Assimp accepts files that are cut off or contradict themselves, and gives what it could read of
// them: a shape with holes. Some others end the program. These look at counts, references and ends,
// and mostly at no coordinates. INVALID_ARGUMENT says what is stated and what is found, and names
// the line of a text or the place in a tree.
absl::StatusOr<MeshContent> CheckStlContent(std::string_view bytes);
// Nothing in an OBJ file says how much there is. One whose last line does not end, or of whose
// vertices some belong to no face, line or point, counts as cut off.
absl::StatusOr<MeshContent> CheckObjContent(std::string_view bytes);
absl::StatusOr<FaceCount> CheckOffContent(std::string_view bytes);
// Of these, assimp reads what is left of the file without all that says nothing about the shape.
absl::StatusOr<MeshContent> CheckDaeContent(std::string_view bytes);
absl::StatusOr<MeshContent> CheckGltfContent(std::string_view bytes);
absl::StatusOr<MeshContent> CheckGlbContent(std::string_view bytes);

// The check for a file's extension (".stl", in lower case); PLY has none, see ply_mesh.h.
absl::StatusOr<MeshContent> CheckMeshContent(const std::string& extension, std::string_view bytes);

// Whether the bytes are a binary STL file of the size that it states.
bool IsWholeBinaryStl(std::string_view bytes);

}  // namespace clearway
