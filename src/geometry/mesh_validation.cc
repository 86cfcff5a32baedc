#include "clearway/geometry/mesh_validation.h"

#include <cstdint>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "geometry/size_limit.h"

namespace clearway {
namespace {

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

// Six times the volume, by the divergence theorem; positive if the triangles face outward.
double SignedVolume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume +=
        (mesh.vertices[a] - mesh.vertices[0])
            .dot((mesh.vertices[b] - mesh.vertices[0]).cross(mesh.vertices[c] - mesh.vertices[0]));
  }
  return volume;
}

}  // namespace

absl::Status ValidateMesh(const std::string& field, const std::shared_ptr<const Mesh>& mesh) {
  if (mesh == nullptr || mesh->triangles.empty()) return Invalid(field, "has no triangles");
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    if (!(mesh->vertices[i].array().abs() <= kMaxSize_m).all()) {
      const Eigen::Vector3d& p = mesh->vertices[i];
      return Invalid(
          absl::StrCat(field, ".vertices_m"),
          absl::StrCat("must be finite and within ", kMaxSize_m, " m; vertex ", i, " is at (",
                       NumberText(p.x()), ", ", NumberText(p.y()), ", ", NumberText(p.z()), ")"));
    }
  }
  for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
    for (std::uint32_t index : mesh->triangles[i]) {
      if (index < mesh->vertices.size()) continue;
      return Invalid(
          absl::StrCat(field, ".triangles"),
          absl::StrCat("name vertex ", index, " of ", mesh->vertices.size(), " in triangle ", i));
    }
  }
  return absl::OkStatus();
}

absl::Status ValidateHull(const std::string& field, const Mesh& mesh) {
  Aabb box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.Extend(vertex);
  const double size_m = box.Size().maxCoeff();
  constexpr double kRelativeTolerance = 1e-6;
  if (!(SignedVolume(mesh) > 1e-9 * size_m * size_m * size_m)) {
    return Invalid(field, "has no volume, or its triangles face inward");
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    const double allowed = kRelativeTolerance * size_m * normal.norm();
    for (const Eigen::Vector3d& vertex : mesh.vertices) {
      if (normal.dot(vertex - mesh.vertices[a]) <= allowed) continue;
      return Invalid(
          absl::StrCat(field, ".triangles"),
          absl::StrCat("are not convex: vertices lie on the outer side of triangle ", i));
    }
  }
  return absl::OkStatus();
}

}  // namespace clearway
