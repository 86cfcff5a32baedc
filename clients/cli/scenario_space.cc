#include "cli/scenario_space.h"

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "cli/json_fields.h"

namespace clearway::cli {
namespace {

absl::StatusOr<PlaneSpace> ParsePlane(const JsonFields& fields) {
  PlaneSpace plane;
  const auto turns = fields.FlagOr("turns", true);
  if (!turns.ok()) return turns.status();
  plane.turns = *turns;
  for (const auto& [name, number] :
       {std::pair{"yaw_rad", &plane.yaw_rad}, {"ground_z_m", &plane.ground_z_m}}) {
    const auto read = fields.NumberOr(name, *number);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  if (fields.Has("clearance_m")) {
    const auto read = fields.Number("clearance_m");
    if (!read.ok()) return read.status();
    if (*read < 0)
      return fields.Error("clearance_m", "is below 0: the robot would be in the ground");
    plane.clearance_m = *read;
  }
  return plane;
}

absl::StatusOr<Joint> ParseJoint(const Json& value, const std::string& path) {
  const auto fields =
      JsonFields::Of(value, path, {"pose", "axis", "min_rad", "max_rad", "max_radps"});
  if (!fields.ok()) return fields.status();
  Joint joint;
  const auto pose = fields->PoseOrIdentity("pose");
  if (!pose.ok()) return pose.status();
  joint.T_P_J = *pose;
  if (fields->Has("axis")) {
    const auto axis = fields->Vector("axis");
    if (!axis.ok()) return axis.status();
    joint.axis_J = *axis;
  }
  for (const auto& [name, number] : {std::pair{"min_rad", &joint.min_rad},
                                     {"max_rad", &joint.max_rad},
                                     {"max_radps", &joint.max_radps}}) {
    const auto read = fields->Number(name);
    if (!read.ok()) return read.status();
    *number = *read;
  }
  if (joint.min_rad > joint.max_rad) {
    return absl::InvalidArgumentError(absl::StrCat(path, ": min_rad is ", NumberText(joint.min_rad),
                                                   "; it must be at most max_rad, which is ",
                                                   NumberText(joint.max_rad)));
  }
  return joint;
}

absl::StatusOr<ArmSpace> ParseArm(const JsonFields& fields) {
  ArmSpace arm;
  const auto base = fields.PoseOrIdentity("base");
  if (!base.ok()) return base.status();
  arm.T_W_B = *base;
  const auto joints = fields.List("joints");
  if (!joints.ok()) return joints.status();
  for (const Json& item : **joints) {
    const auto joint =
        ParseJoint(item, fields.PathOf(absl::StrCat("joints[", arm.joints.size(), "]")));
    if (!joint.ok()) return joint.status();
    arm.joints.push_back(*joint);
  }
  return arm;
}

absl::StatusOr<FlightSpace> ParseFlight(const JsonFields& fields) {
  const auto turns = fields.FlagOr("turns", true);
  if (!turns.ok()) return turns.status();
  return FlightSpace{*turns};
}

template <class Parse>
absl::StatusOr<ConfigurationSpace> As(const Json& value, const std::string& path,
                                      std::initializer_list<const char*> known, Parse&& parse) {
  const auto fields = JsonFields::Of(value, path, known);
  if (!fields.ok()) return fields.status();
  auto parsed = parse(*fields);
  if (!parsed.ok()) return parsed.status();
  return ConfigurationSpace(*std::move(parsed));
}

}  // namespace

absl::StatusOr<ConfigurationSpace> ParseSpace(const Json& value, const std::string& path) {
  const bool typed = value.is_object() && value.contains("type") && value.at("type").is_string();
  const std::string type = typed ? value.at("type").get<std::string>() : "";
  if (type == "plane") {
    return As(value, path, {"type", "turns", "yaw_rad", "ground_z_m", "clearance_m"}, ParsePlane);
  }
  if (type == "flight") return As(value, path, {"type", "turns"}, ParseFlight);
  if (type == "arm") return As(value, path, {"type", "base", "joints"}, ParseArm);
  return absl::InvalidArgumentError(absl::StrCat(path, ".type: expected plane, flight or arm"));
}

}  // namespace clearway::cli
