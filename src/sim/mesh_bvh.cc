#include "sim/mesh_bvh.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "sim/ray_shape.h"

namespace clearway {
namespace {

constexpr std::size_t kLeafSize = 4;
constexpr std::size_t kMaxDepth = 64;  // median splits: enough for any number of triangles

}  // namespace

MeshBvh::MeshBvh(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
  order_.resize(mesh_->triangles.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (!order_.empty()) Build(0, order_.size());
}

Aabb MeshBvh::BoxOf(std::size_t begin, std::size_t end) const {
  Aabb box;
  for (std::size_t i = begin; i < end; ++i) {
    for (std::uint32_t vertex : mesh_->triangles[order_[i]]) box.Extend(mesh_->vertices[vertex]);
  }
  // Flat boxes would lose hits to rounding.
  return box.Padded(1e-9);
}

void MeshBvh::Build(std::size_t begin, std::size_t end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back({.box = BoxOf(begin, end),
                    .first = static_cast<std::uint32_t>(begin),
                    .count = static_cast<std::uint32_t>(end - begin)});
  if (end - begin <= kLeafSize) return;
  int axis = 0;
  nodes_[index].box.Size().maxCoeff(&axis);
  const auto key = [&](std::uint32_t triangle) {
    const auto& [a, b, c] = mesh_->triangles[triangle];
    return mesh_->vertices[a][axis] + mesh_->vertices[b][axis] + mesh_->vertices[c][axis];
  };
  const std::size_t middle = (begin + end) / 2;
  // Ties are broken by index, so that the tree is the same with every standard library.
  std::sort(order_.begin() + begin, order_.begin() + end, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  Build(begin, middle);
  nodes_[index].count = 0;
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  Build(middle, end);
}

double MeshBvh::RayDistance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  if (nodes_.empty()) return kNoHit;
  double nearest = kNoHit;
  std::array<std::uint32_t, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    const RayInterval in = IntervalInBox(node.box, origin, direction);
    if (in.enter > in.leave || in.leave < 0 || in.enter > nearest) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& [a, b, c] = mesh_->triangles[order_[i]];
      const double distance = RayDistanceToTriangle(mesh_->vertices[a], mesh_->vertices[b],
                                                    mesh_->vertices[c], origin, direction);
      nearest = std::min(nearest, distance);
    }
  }
  return nearest;
}

}  // namespace clearway
