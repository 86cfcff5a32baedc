#include "clearway/scene/scene_params.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

absl::Status CheckResolution(const char* field, double value_m) {
  if (value_m >= 0.001 && value_m <= 100.0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " is ", NumberText(value_m), "; it must lie between 0.001 and 100 m"));
}

absl::Status CheckDuration(const char* field, Duration value) {
  if (value >= Duration::zero() && value <= std::chrono::hours(24)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(field, " is ", NumberText(ToSeconds(value)),
                                                 " s; it must lie between 0 and 86400 s"));
}

// The way that tells which half of an object was not seen is that of a second.
absl::Status CheckCompletion(const SceneParams& params) {
  constexpr Duration kLeast = std::chrono::seconds(1);
  if (params.solid != SolidMode::kCompletedHull || params.history >= kLeast) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("history_s is ", NumberText(ToSeconds(params.history)),
                   " s; with completed hulls it must be at least ", ToSeconds(kLeast), " s"));
}

absl::Status CheckRestDistance(double value_m) {
  if (value_m >= 0 && value_m <= 10) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("rest_distance_m is ", NumberText(value_m), "; it must lie between 0 and 10 m"));
}

absl::Status CheckGrazing(double value_m) {
  if (value_m >= 0 && value_m <= 100) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("grazing_m is ", NumberText(value_m), "; it must lie between 0 and 100 m"));
}

absl::Status CheckPoseErrors(const char* of, double value_m, double value_rad) {
  if (!(value_m >= 0 && value_m <= 10)) {
    return absl::InvalidArgumentError(absl::StrCat(of, "_pose_error_m is ", NumberText(value_m),
                                                   "; it must lie between 0 and 10 m"));
  }
  if (value_rad >= 0 && value_rad <= 1) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(of, "_pose_error_rad is ", NumberText(value_rad),
                                                 "; it must lie between 0 and 1"));
}

absl::Status CheckKeepDistance(double value_m) {
  if (value_m == 0 || (value_m >= 1 && std::isfinite(value_m))) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("keep_distance_m is ", NumberText(value_m),
                   "; it must be at least 1 m, or 0 to forget nothing"));
}

absl::Status CheckBox(const std::string& field, const Aabb& box) {
  if (box.min.allFinite() && box.max.allFinite() && !box.Empty()) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " must be finite with min at most max on each axis"));
}

absl::Status CheckBoxes(const char* field, const std::vector<Aabb>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (auto s = CheckBox(absl::StrCat(field, "[", i, "]"), boxes[i]); !s.ok()) return s;
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status Validate(const SceneParams& params) {
  if (params.rays.max_range_m == 0 || !std::isfinite(params.rays.max_range_m)) {
    return absl::InvalidArgumentError(
        absl::StrCat("max_range_m is ", NumberText(params.rays.max_range_m),
                     "; it must be finite and positive, or negative for no limit"));
  }
  for (const absl::Status& status :
       {CheckResolution("resolution_m", params.resolution_m),
        CheckResolution("object_resolution_m", params.object_resolution_m),
        Validate(params.occupancy), CheckDuration("horizon_s", params.horizon),
        CheckDuration("object_lifetime_s", params.object_lifetime),
        CheckDuration("history_s", params.history), CheckCompletion(params),
        CheckDuration("dynamic_life_s", params.dynamic_life),
        CheckDuration("dynamic_settle_s", params.dynamic_settle),
        CheckRestDistance(params.rest_distance_m),
        CheckPoseErrors("object", params.object_pose_error_m, params.object_pose_error_rad),
        CheckPoseErrors("sensor", params.sensor_pose_error_m, params.sensor_pose_error_rad),
        CheckKeepDistance(params.keep_distance_m), CheckGrazing(params.rays.grazing_m),
        CheckBox("bounds", params.bounds_W), CheckBoxes("keep_out", params.keep_out_W),
        CheckBoxes("self_filter", params.self_filter_S)}) {
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

}  // namespace clearway
