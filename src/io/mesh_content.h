// Whether a mesh file holds all that it promises.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace clearway {

// How many faces of three corners or more a file holds; none where it does not say.
using FaceCount = std::optional<std::uint64_t>;

// Assimp accepts files that are cut off or contradict themselves, and gives what it could read of
// them: a shape with holes. These look at counts, references and ends alone, and read no
// coordinates. INVALID_ARGUMENT says what is stated and what is found, and names the line of a
// text.
absl::StatusOr<FaceCount> CheckStlContent(std::string_view bytes);
// Nothing in an OBJ file says how much there is. One whose last line does not end, or of whose
// vertices some belong to no face, line or point, counts as cut off.
absl::StatusOr<FaceCount> CheckObjContent(std::string_view bytes);
absl::StatusOr<FaceCount> CheckOffContent(std::string_view bytes);
absl::StatusOr<FaceCount> CheckPlyContent(std::string_view bytes);

// The check for a file's extension (".stl", in lower case); other formats are not looked into, as
// they are XML, JSON or have lengths that assimp compares.
absl::StatusOr<FaceCount> CheckMeshContent(const std::string& extension, std::string_view bytes);

// Whether the bytes are a binary STL file of the size that it states.
bool IsWholeBinaryStl(std::string_view bytes);

}  // namespace clearway
