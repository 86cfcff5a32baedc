#include "cli/robot_shape.h"

#include <algorithm>
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/geometry/hull.h"
#include "clearway/io/mesh_file.h"
#include "cli/json_fields.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

absl::StatusOr<Shape> BoxOf(const JsonFields& fields) {
  const auto size = fields.Vector("size_m");
  if (!size.ok()) return size.status();
  if (size->minCoeff() <= 0) return fields.Error("size_m", "expected lengths above 0");
  return Box{*size};
}

// A shape along z, of type Cylinder or Capsule.
template <class T>
absl::StatusOr<Shape> RoundOf(const JsonFields& fields) {
  const auto radius = fields.Positive("radius_m");
  if (!radius.ok()) return radius.status();
  const auto length = fields.Positive("length_m");
  if (!length.ok()) return length.status();
  return T{*radius, *length};
}

absl::StatusOr<Shape> SphereOf(const JsonFields& fields) {
  const auto radius = fields.Positive("radius_m");
  if (!radius.ok()) return radius.status();
  return Sphere{*radius};
}

absl::StatusOr<Mesh> MeshOf(const JsonFields& fields, const std::filesystem::path& folder) {
  const auto file = fields.Text("file");
  if (!file.ok()) return file.status();
  MeshFileOptions options;
  if (fields.Has("scale")) {
    const auto scale = fields.Positive("scale");
    if (!scale.ok()) return scale.status();
    options.scale = *scale;
  }
  auto mesh = ReadMesh(folder / *file, options);
  if (!mesh.ok()) return fields.Error("file", std::string(mesh.status().message()));
  return mesh;
}

// The hull of a mesh file's vertices, or of points in the file itself.
absl::StatusOr<Shape> HullOf(const JsonFields& fields, const std::filesystem::path& folder) {
  const char* const source = fields.Has("points_m") ? "points_m" : "file";
  if (fields.Has("points_m") && fields.Has("file")) {
    return fields.Error("points_m", "give this or file, not both");
  }
  std::vector<Eigen::Vector3d> points;
  if (fields.Has("points_m")) {
    auto listed = fields.Vectors("points_m");
    if (!listed.ok()) return listed.status();
    points = *std::move(listed);
  } else {
    auto mesh = MeshOf(fields, folder);
    if (!mesh.ok()) return mesh.status();
    points = std::move(mesh->vertices);
  }
  auto hull = std::make_shared<const Mesh>(ConvexHullOf(points));
  if (hull->triangles.empty()) return fields.Error(source, "the points do not span a volume");
  return ConvexPolytope{std::move(hull)};
}

absl::StatusOr<Shape> ShapeOf(const JsonFields& fields, const std::string& type,
                              const std::filesystem::path& folder) {
  if (type == "box") return BoxOf(fields);
  if (type == "sphere") return SphereOf(fields);
  if (type == "cylinder") return RoundOf<Cylinder>(fields);
  if (type == "capsule") return RoundOf<Capsule>(fields);
  if (type == "hull") return HullOf(fields, folder);
  auto mesh = MeshOf(fields, folder);
  if (!mesh.ok()) return mesh.status();
  return TriangleMesh{std::make_shared<const Mesh>(*std::move(mesh))};
}

// The fields that belong to a type; a field of another one is an error.
absl::StatusOr<JsonFields> FieldsOf(const Json& value, const std::string& path,
                                    const std::string& type) {
  if (type == "box") return JsonFields::Of(value, path, {"type", "pose", "size_m"});
  if (type == "sphere") return JsonFields::Of(value, path, {"type", "pose", "radius_m"});
  if (type == "cylinder" || type == "capsule") {
    return JsonFields::Of(value, path, {"type", "pose", "radius_m", "length_m"});
  }
  if (type == "hull") {
    return JsonFields::Of(value, path, {"type", "pose", "points_m", "file", "scale"});
  }
  if (type == "mesh") return JsonFields::Of(value, path, {"type", "pose", "file", "scale"});
  return absl::InvalidArgumentError(absl::StrCat(
      path, ".type: expected box, sphere, cylinder, capsule, hull or mesh, not \"", type, "\""));
}

}  // namespace

absl::StatusOr<LinkShape> ParseLinkShape(const Json& value, const std::string& path,
                                         const std::filesystem::path& folder) {
  const auto any = JsonFields::Of(
      value, path, {"type", "pose", "size_m", "radius_m", "length_m", "points_m", "file", "scale"});
  if (!any.ok()) return any.status();
  const auto type = any->Text("type");
  if (!type.ok()) return type.status();
  const auto fields = FieldsOf(value, path, *type);
  if (!fields.ok()) return fields.status();
  const auto T_L_G = fields->PoseOrIdentity("pose");
  if (!T_L_G.ok()) return T_L_G.status();
  auto shape = ShapeOf(*fields, *type, folder);
  if (!shape.ok()) return shape.status();
  return LinkShape{*std::move(shape), *T_L_G};
}

absl::StatusOr<Shape> ParseShapeText(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string type = text.substr(0, colon);
  const auto numbers = ParseNumbers(colon == std::string::npos ? "" : text.substr(colon + 1));
  const std::size_t count = numbers.ok() ? numbers->size() : 0;
  const bool positive =
      numbers.ok() && std::all_of(numbers->begin(), numbers->end(), [](double n) { return n > 0; });
  if (positive && type == "box" && count == 3) {
    return Box{{(*numbers)[0], (*numbers)[1], (*numbers)[2]}};
  }
  if (positive && type == "sphere" && count == 1) return Sphere{(*numbers)[0]};
  if (positive && type == "cylinder" && count == 2) return Cylinder{(*numbers)[0], (*numbers)[1]};
  if (positive && type == "capsule" && count == 2) return Capsule{(*numbers)[0], (*numbers)[1]};
  return absl::InvalidArgumentError(
      absl::StrCat("expected box:x,y,z, sphere:radius, cylinder:radius,length or "
                   "capsule:radius,length in metres, not '",
                   text, "'", numbers.ok() && !positive ? "; lengths are above 0" : ""));
}

}  // namespace clearway::cli
