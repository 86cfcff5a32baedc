#include <algorithm>
#include <initializer_list>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/shape.h"

namespace clearway {
namespace {

constexpr double kMaxSize_m = 100;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

absl::Status CheckSize(const std::string& field, double size_m) {
  if (size_m > 0 && size_m <= kMaxSize_m) return absl::OkStatus();  // false for NaN
  return Invalid(field,
                 absl::StrCat("is ", NumberText(size_m), "; it must be positive and at most ",
                              NumberText(kMaxSize_m), " m"));
}

absl::Status FirstError(std::initializer_list<absl::Status> statuses) {
  for (const absl::Status& status : statuses) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status CheckMesh(const std::string& field, const std::shared_ptr<const Mesh>& mesh) {
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

// That something can touch the mesh: a triangle of more than rounding's height. Whatever lies at
// triangles that are lines or points is missed.
absl::Status CheckArea(const std::string& field, const Mesh& mesh) {
  constexpr double kRelativeTolerance = 1e-6;
  double longest_m = 0, highest_m = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d ab = mesh.vertices[b] - mesh.vertices[a],
                          ac = mesh.vertices[c] - mesh.vertices[a];
    const double side_m = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    longest_m = std::max(longest_m, side_m);
    if (side_m > 0) highest_m = std::max(highest_m, ab.cross(ac).norm() / side_m);
  }
  if (highest_m > kRelativeTolerance * longest_m) return absl::OkStatus();
  return Invalid(absl::StrCat(field, ".triangles"),
                 absl::StrCat("have no area: of all ", mesh.triangles.size(),
                              " the corners lie on a line or are one point"));
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

// That the mesh is the boundary of a convex body: every vertex on the inner side of every triangle.
absl::Status CheckHull(const std::string& field, const Mesh& mesh) {
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

struct CheckShape {
  const std::string& field;
  absl::Status operator()(const Sphere& s) const {
    return CheckSize(absl::StrCat(field, ".sphere.radius_m"), s.radius_m);
  }
  absl::Status operator()(const Box& b) const {
    return FirstError({CheckSize(absl::StrCat(field, ".box.size_m.x"), b.size_m.x()),
                       CheckSize(absl::StrCat(field, ".box.size_m.y"), b.size_m.y()),
                       CheckSize(absl::StrCat(field, ".box.size_m.z"), b.size_m.z())});
  }
  absl::Status operator()(const Capsule& c) const {
    return FirstError({CheckSize(absl::StrCat(field, ".capsule.radius_m"), c.radius_m),
                       CheckSize(absl::StrCat(field, ".capsule.length_m"), c.length_m)});
  }
  absl::Status operator()(const Cylinder& c) const {
    return FirstError({CheckSize(absl::StrCat(field, ".cylinder.radius_m"), c.radius_m),
                       CheckSize(absl::StrCat(field, ".cylinder.length_m"), c.length_m)});
  }
  absl::Status operator()(const ConvexPolytope& c) const {
    const std::string mesh_field = absl::StrCat(field, ".convex");
    if (auto status = CheckMesh(mesh_field, c.mesh); !status.ok()) return status;
    return CheckHull(mesh_field, *c.mesh);
  }
  absl::Status operator()(const TriangleMesh& t) const {
    const std::string mesh_field = absl::StrCat(field, ".mesh");
    if (auto status = CheckMesh(mesh_field, t.mesh); !status.ok()) return status;
    return CheckArea(mesh_field, *t.mesh);
  }
};

}  // namespace

absl::Status Validate(const std::string& field, const Shape& shape) {
  return std::visit(CheckShape{field}, shape);
}

}  // namespace clearway
