#include "cli/json.h"

namespace clearway::cli {

Json ToJson(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

Json ToJson(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {{"rotation_xyzw", Json::array({q.x(), q.y(), q.z(), q.w()})},
          {"translation_m", ToJson(pose.translation)}};
}

Json ToJson(const Aabb& box) {
  if (box.Empty()) return nullptr;
  return {{"min_m", ToJson(box.min)}, {"max_m", ToJson(box.max)}};
}

Json ToJson(SpaceStatus status) {
  switch (status) {
    case SpaceStatus::kFree:
      return "FREE";
    case SpaceStatus::kUnknownSpace:
      return "UNKNOWN_SPACE";
    case SpaceStatus::kBeyondHorizon:
      return "BEYOND_HORIZON";
    case SpaceStatus::kOccupied:
      return "OCCUPIED";
    case SpaceStatus::kOutOfBounds:
      return "OUT_OF_BOUNDS";
    case SpaceStatus::kUnresolved:
      return "UNRESOLVED";
  }
  return "UNRESOLVED";
}

Json ToJson(const Versioned& answer) {
  return {{"version", answer.version}, {"stamp_ns", ToNanoseconds(answer.stamp)}};
}

void Print(std::ostream& out, const Json& json) {
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace clearway::cli
