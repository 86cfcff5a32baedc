#include <algorithm>
#include <initializer_list>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/mesh_validation.h"
#include "clearway/geometry/shape.h"
#include "geometry/size_limit.h"

namespace clearway {
namespace {

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
    if (auto status = ValidateMesh(mesh_field, c.mesh); !status.ok()) return status;
    return ValidateHull(mesh_field, *c.mesh);
  }
  absl::Status operator()(const TriangleMesh& t) const {
    const std::string mesh_field = absl::StrCat(field, ".mesh");
    if (auto status = ValidateMesh(mesh_field, t.mesh); !status.ok()) return status;
    return CheckArea(mesh_field, *t.mesh);
  }
};

}  // namespace

absl::Status Validate(const std::string& field, const Shape& shape) {
  return std::visit(CheckShape{field}, shape);
}

}  // namespace clearway
