#include "cli/scenario_objects.h"

#include <map>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "cli/json_fields.h"
#include "cli/robot_shape.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr double kMaxId = 999'999'999;

// The object's frame is its shape's: what `pose` the shape has in it is added to its own.
absl::Status ParseShape(const JsonFields& fields, const Json& value,
                        const std::filesystem::path& folder, GivenObject& object) {
  if (!value.contains("shape")) return fields.Error("shape", "missing");
  auto shape = ParseLinkShape(value.at("shape"), fields.PathOf("shape"), folder);
  if (!shape.ok()) return shape.status();
  if (!(shape->T_L_G == Pose{})) {
    return fields.Error("shape.pose", "an object's frame is its shape's: give the object's pose");
  }
  object.shape = std::move(shape->shape);
  return absl::OkStatus();
}

absl::StatusOr<StampedPose> ParseStampedPose(const Json& value, const std::string& path) {
  const auto fields = JsonFields::Of(value, path, {"t_s", "pose"});
  if (!fields.ok()) return fields.status();
  const auto t = fields->Seconds("t_s");
  if (!t.ok()) return t.status();
  const auto pose = fields->PoseOrIdentity("pose");
  if (!pose.ok()) return pose.status();
  return StampedPose{Time() + *t, *pose};
}

absl::Status ParseMotion(const JsonFields& fields, const Json& value, GivenObject& object) {
  if (fields.Has("velocity_mps")) {
    const auto velocity = fields.Vector("velocity_mps");
    if (!velocity.ok()) return velocity.status();
    object.velocity_O = Twist{Eigen::Vector3d::Zero(), *velocity};
  }
  if (!fields.Has("future")) return absl::OkStatus();
  if (object.velocity_O) {
    return fields.Error("future", "the object has velocity_mps, too; give one of them");
  }
  const auto list = fields.List("future");
  if (!list.ok()) return list.status();
  for (const Json& item : value.at("future")) {
    const std::string path = fields.PathOf(absl::StrCat("future[", object.future.size(), "]"));
    const auto pose = ParseStampedPose(item, path);
    if (!pose.ok()) return pose.status();
    const Time last = object.future.empty() ? object.pose.stamp : object.future.back().stamp;
    if (pose->stamp <= last) {
      return absl::InvalidArgumentError(absl::StrCat(
          path, ".t_s: is ", Seconds(pose->stamp), "; it must be above ", Seconds(last),
          object.future.empty() ? ", the time of the object's pose" : ", the one before it"));
    }
    object.future.push_back(*pose);
  }
  return absl::OkStatus();
}

absl::StatusOr<GivenObject> ParseGivenObject(const Json& value, const std::string& path,
                                             const std::filesystem::path& folder) {
  const auto fields =
      JsonFields::Of(value, path, {"id", "about", "shape", "pose", "velocity_mps", "future"});
  if (!fields.ok()) return fields.status();
  GivenObject object;
  const auto id = fields->Positive("id");
  if (!id.ok()) return id.status();
  object.id = static_cast<ObjectId>(std::min(*id, kMaxId));
  if (object.id != *id) {
    return fields->Error("id", absl::StrCat("expected a whole number from 1 to ",
                                            NumberText(kMaxId), ", not ", NumberText(*id)));
  }
  if (auto status = ParseShape(*fields, value, folder, object); !status.ok()) return status;
  const auto pose = fields->PoseOrIdentity("pose");
  if (!pose.ok()) return pose.status();
  object.pose = {Time(), *pose};
  if (auto status = ParseMotion(*fields, value, object); !status.ok()) return status;
  return object;
}

}  // namespace

absl::StatusOr<std::vector<GivenObject>> ParseGivenObjects(const Json& list,
                                                           const std::string& path,
                                                           const std::filesystem::path& folder) {
  std::vector<GivenObject> objects;
  std::map<ObjectId, std::size_t> places;
  for (const Json& item : list) {
    auto object = ParseGivenObject(item, absl::StrCat(path, "[", objects.size(), "]"), folder);
    if (!object.ok()) return object.status();
    const auto [place, is_new] = places.emplace(object->id, objects.size());
    if (!is_new) {
      return absl::InvalidArgumentError(absl::StrCat(path, "[", objects.size(),
                                                     "].id: ", object->id, " is the id of ", path,
                                                     "[", place->second, "], too"));
    }
    objects.push_back(*std::move(object));
  }
  return objects;
}

}  // namespace clearway::cli
