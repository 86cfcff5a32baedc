// Triangles, one after the other, joined to a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "absl/container/flat_hash_map.h"
#include "absl/status/statusor.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// Makes one vertex of all corners with the same coordinates. One thread.
class MeshBuilder {
 public:
  explicit MeshBuilder(std::size_t max_triangles) : max_triangles_(max_triangles) {}

  // Adds a triangle with finite corners, or leaves it out if it has no area; says whether it has
  // one. RESOURCE_EXHAUSTED above the limit; INVALID_ARGUMENT if its area is too large a number.
  absl::StatusOr<bool> Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c);

  // Returns the mesh, which is no longer here then. INVALID_ARGUMENT if it has no triangles.
  absl::StatusOr<Mesh> Finish();

 private:
  std::uint32_t IndexOf(const Eigen::Vector3d& p);

  std::size_t max_triangles_;
  Mesh mesh_;
  absl::flat_hash_map<std::array<double, 3>, std::uint32_t> indices_;  // of vertices
};

}  // namespace clearway
