// Whether assimp has read what a file holds.
#pragma once

#include <assimp/scene.h>

#include "absl/status/status.h"
#include "io/mesh_content.h"

namespace clearway {

// Assimp leaves out faces that it cannot read. To be called before it cuts them into triangles: it
// ends the program at one without a corner. INVALID_ARGUMENT names the part.
absl::Status CheckImported(const aiScene& scene, const MeshContent& content);

}  // namespace clearway
