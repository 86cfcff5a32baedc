// Whether meshes can be used.
#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// INVALID_ARGUMENT naming what of `field` is wrong: no triangles, indices that are out of range,
// vertices that are not finite or beyond 100 m.
absl::Status ValidateMesh(const std::string& field, const std::shared_ptr<const Mesh>& mesh);

// INVALID_ARGUMENT naming what of `field` is wrong unless the mesh, which must be valid, is the
// boundary of a convex body and faces outward: every vertex lies on the inner side of every
// triangle. Takes time in proportion to triangles times vertices.
absl::Status ValidateHull(const std::string& field, const Mesh& mesh);

}  // namespace clearway
