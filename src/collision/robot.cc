#include "clearway/collision/robot.h"

#include <initializer_list>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "clearway/geometry/solid_mesh.h"
#include "clearway/scene/frame.h"

namespace clearway {
namespace {

constexpr double kMaxSize_m = 100;
constexpr std::size_t kMaxShapesPerLink = 1000;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

absl::Status FirstError(std::initializer_list<absl::Status> statuses) {
  for (const absl::Status& status : statuses) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

}  // namespace

Robot Robot::SingleShape(std::string name, Shape shape) {
  return {name, {{name, {{std::move(shape), Pose{}}}}}};
}

absl::Status Validate(const Robot& robot) {
  if (robot.links.empty()) return Invalid("links", "is empty");
  for (std::size_t l = 0; l < robot.links.size(); ++l) {
    const std::string shapes_field = absl::StrCat("links[", l, "].shapes");
    const std::size_t count = robot.links[l].shapes.size();
    if (count == 0) return Invalid(shapes_field, "is empty");
    if (count > kMaxShapesPerLink) {
      return Invalid(shapes_field,
                     absl::StrCat("has ", count, " items; the limit is ", kMaxShapesPerLink));
    }
    for (std::size_t s = 0; s < count; ++s) {
      const LinkShape& part = robot.links[l].shapes[s];
      const std::string field = absl::StrCat(shapes_field, "[", s, "]");
      if (auto status = FirstError(
              {ValidatePose(absl::StrCat(field, ".link_from_shape"), part.T_L_G, kMaxSize_m),
               Validate(field, part.shape)});
          !status.ok()) {
        return status;
      }
    }
  }
  return absl::OkStatus();
}

SolidRobot WithSolidMeshes(Robot robot) {
  SolidRobot solid{std::move(robot), {}};
  for (std::size_t l = 0; l < solid.robot.links.size(); ++l) {
    std::vector<LinkShape>& shapes = solid.robot.links[l].shapes;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      auto* const mesh = std::get_if<TriangleMesh>(&shapes[s].shape);
      if (mesh == nullptr) continue;
      auto [solid_mesh, note] = SolidMeshOf(mesh->mesh);
      mesh->mesh = std::move(solid_mesh);
      if (note.empty()) continue;
      solid.notes.push_back(absl::StrCat("links[", l, "].shapes[", s, "].mesh: ", note));
    }
  }
  return solid;
}

}  // namespace clearway
