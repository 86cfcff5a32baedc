#include "cli/robot_file.h"

#include <set>

#include "absl/strings/str_cat.h"
#include "cli/json_fields.h"
#include "cli/json_file.h"
#include "cli/message.h"
#include "cli/robot_shape.h"

namespace clearway::cli {
namespace {

absl::StatusOr<Link> ParseLink(const JsonFields& fields, const std::filesystem::path& folder) {
  Link link;
  const auto name = fields.Text("name");
  if (!name.ok()) return name.status();
  link.name = *name;
  const auto shapes = fields.List("shapes");
  if (!shapes.ok()) return shapes.status();
  for (std::size_t i = 0; i < (*shapes)->size(); ++i) {
    auto shape =
        ParseLinkShape((**shapes)[i], fields.PathOf(absl::StrCat("shapes[", i, "]")), folder);
    if (!shape.ok()) return shape.status();
    link.shapes.push_back(*std::move(shape));
  }
  return link;
}

absl::StatusOr<RobotFile> RobotOf(const Json& json, const std::filesystem::path& folder) {
  const auto fields = JsonFields::Of(json, "", {"name", "links"});
  if (!fields.ok()) return fields.status();
  const auto name = fields->Text("name");
  if (!name.ok()) return name.status();
  const auto links = fields->List("links");
  if (!links.ok()) return links.status();
  RobotFile file;
  file.robot.name = *name;
  std::set<std::string> names;
  for (std::size_t i = 0; i < (*links)->size(); ++i) {
    const auto link_fields =
        JsonFields::Of((**links)[i], absl::StrCat("links[", i, "]"), {"name", "pose", "shapes"});
    if (!link_fields.ok()) return link_fields.status();
    auto link = ParseLink(*link_fields, folder);
    if (!link.ok()) return link.status();
    if (!names.insert(link->name).second) {
      return link_fields->Error("name", "two links are called \"" + link->name + "\"");
    }
    const auto T_R_L = link_fields->PoseOrIdentity("pose");
    if (!T_R_L.ok()) return T_R_L.status();
    file.robot.links.push_back(*std::move(link));
    file.T_R_L.push_back(*T_R_L);
  }
  return file;
}

}  // namespace

absl::StatusOr<RobotFile> ParseRobot(const std::filesystem::path& name, const std::string& text) {
  const auto json = ParseJson(text);
  if (!json.ok()) return InContext(name.string(), json.status());
  auto robot = RobotOf(*json, name.parent_path());
  if (!robot.ok()) return InContext(name.string(), robot.status());
  return robot;
}

absl::StatusOr<RobotFile> ParseShortRobot(const std::string& text) {
  auto shape = ParseShapeText(text);
  if (!shape.ok()) return shape.status();
  RobotFile file{Robot::SingleShape(text, *std::move(shape)), {Pose{}}};
  file.robot.links[0].name = "body";
  return file;
}

absl::StatusOr<RobotFile> LoadRobot(const std::string& file_or_shape) {
  if (!std::filesystem::exists(file_or_shape) && file_or_shape.find(':') != std::string::npos) {
    auto file = ParseShortRobot(file_or_shape);
    if (!file.ok()) return UsageError(absl::StrCat("--robot: ", file.status().message()));
    return file;
  }
  const auto text =
      ReadTextFile(file_or_shape, "robot file", " (or write a shape, as box:1,0.7,1)");
  if (!text.ok()) return text.status();
  return ParseRobot(file_or_shape, *text);
}

}  // namespace clearway::cli
