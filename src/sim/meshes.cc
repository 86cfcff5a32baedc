#include "sim/meshes.h"

namespace clearway {

std::shared_ptr<const Mesh> Extruded(const std::vector<Eigen::Vector2d>& profile_xz,
                                     double width_m) {
  auto mesh = std::make_shared<Mesh>();
  const auto n = static_cast<std::uint32_t>(profile_xz.size());
  for (const double y : {-width_m / 2, width_m / 2}) {
    for (const Eigen::Vector2d& p : profile_xz) mesh->vertices.emplace_back(p.x(), y, p.y());
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i) {
    mesh->triangles.push_back({0, i, i + 1});
    mesh->triangles.push_back({n, n + i + 1, n + i});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh->triangles.push_back({i, n + i, n + next});
    mesh->triangles.push_back({i, n + next, next});
  }
  return mesh;
}

}  // namespace clearway
