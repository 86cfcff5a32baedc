#include "io/mesh_builder.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {

absl::StatusOr<bool> MeshBuilder::Add(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& c) {
  const double area = (b - a).cross(c - a).norm();
  if (!std::isfinite(area)) {
    return absl::InvalidArgumentError("a triangle is too large: its area is not finite");
  }
  if (area == 0) return false;
  constexpr std::size_t kMaxVertices = std::numeric_limits<std::uint32_t>::max();
  if (mesh_.triangles.size() >= max_triangles_ || mesh_.vertices.size() > kMaxVertices - 3) {
    return absl::ResourceExhaustedError(
        absl::StrCat("more than ", mesh_.triangles.size(), " triangles, the limit"));
  }
  const std::uint32_t index_a = IndexOf(a), index_b = IndexOf(b), index_c = IndexOf(c);
  mesh_.triangles.push_back({index_a, index_b, index_c});
  return true;
}

absl::StatusOr<Mesh> MeshBuilder::Finish() {
  if (mesh_.triangles.empty()) return absl::InvalidArgumentError("no triangle with an area");
  return std::exchange(mesh_, {});
}

std::uint32_t MeshBuilder::IndexOf(const Eigen::Vector3d& p) {
  const auto [it, fresh] = indices_.try_emplace({p.x(), p.y(), p.z()},
                                                static_cast<std::uint32_t>(mesh_.vertices.size()));
  if (fresh) mesh_.vertices.push_back(p);
  return it->second;
}

}  // namespace clearway
