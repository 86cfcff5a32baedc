// Rays against triangle meshes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// A tree of boxes over a mesh's triangles. Immutable; any thread may read it.
class MeshBvh {
 public:
  explicit MeshBvh(std::shared_ptr<const Mesh> mesh);

  // Distance along the unit direction to the first triangle, or kNoHit.
  double RayDistance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

 private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  // of the leaf's triangles, or the right child's index
    std::uint32_t count = 0;  // of the leaf's triangles; 0: inner node, left child is next
  };
  void Build(std::size_t begin, std::size_t end);
  Aabb BoxOf(std::size_t begin, std::size_t end) const;

  std::shared_ptr<const Mesh> mesh_;
  std::vector<std::uint32_t> order_;  // triangles, leaf by leaf
  std::vector<Node> nodes_;
};

}  // namespace clearway
