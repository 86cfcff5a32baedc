// The table of all keys.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"
#include "server/config.h"

namespace clearway {
namespace {

absl::Status Bad(const std::string& text, const char* wanted) {
  return absl::InvalidArgumentError(absl::StrCat("\"", text, "\" is not ", wanted));
}

// One pair for each kind of value: from text, and to TOML.
absl::Status Parse(const std::string& text, std::string& value) {
  value = text;
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, bool& value) {
  return absl::SimpleAtob(text, &value) ? absl::OkStatus() : Bad(text, "true or false");
}
absl::Status Parse(const std::string& text, double& value) {
  return absl::SimpleAtod(text, &value) && std::isfinite(value) ? absl::OkStatus()
                                                                : Bad(text, "a number");
}
absl::Status Parse(const std::string& text, int& value) {
  return absl::SimpleAtoi(text, &value) ? absl::OkStatus() : Bad(text, "a whole number");
}
absl::Status Parse(const std::string& text, std::uint64_t& value) {
  return absl::SimpleAtoi(text, &value) ? absl::OkStatus()
                                        : Bad(text, "a whole number that is not negative");
}
absl::Status Parse(const std::string& text, Duration& value) {
  double seconds = 0;
  constexpr double kLimit_s = 1e9;
  if (!absl::SimpleAtod(text, &seconds) || !(std::abs(seconds) <= kLimit_s)) {
    return Bad(text, "a time in seconds");
  }
  value = FromSeconds(seconds);
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, SolidMode& value) {
  const auto name = std::ranges::find(kSolidModeNames, text);
  if (name == kSolidModeNames.end()) return Bad(text, "convex_hull, completed_hull or voxels");
  value = static_cast<SolidMode>(name - kSolidModeNames.begin());
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, MotionModel& value) {
  if (text != "last" && text != "track") return Bad(text, "last or track");
  value = text == "track" ? MotionModel::kTrack : MotionModel::kLastMotion;
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, MotionFromPoints& value) {
  const auto name = std::ranges::find(kMotionFromPointsNames, text);
  if (name == kMotionFromPointsNames.end()) return Bad(text, "auto, on or off");
  value = static_cast<MotionFromPoints>(name - kMotionFromPointsNames.begin());
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, std::vector<Aabb>& boxes) {
  std::vector<double> numbers;
  for (const auto& part : absl::StrSplit(text, absl::ByAnyChar(" ,;[]"), absl::SkipEmpty())) {
    if (!absl::SimpleAtod(part, &numbers.emplace_back())) return Bad(text, "a list of numbers");
  }
  if (numbers.size() % 6 != 0) return Bad(text, "a list of six numbers a box: minimum, maximum");
  boxes.clear();
  for (std::size_t i = 0; i < numbers.size(); i += 6) {
    const double* n = &numbers[i];
    boxes.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
  }
  return absl::OkStatus();
}
absl::Status Parse(const std::string& text, Aabb& box) {
  std::vector<Aabb> boxes;
  if (auto status = Parse(text, boxes); !status.ok()) return status;
  if (boxes.size() != 1) return Bad(text, "six numbers: minimum, maximum");
  box = boxes.front();
  return absl::OkStatus();
}

std::string Print(const std::string& value) {
  return absl::StrCat("\"", absl::StrReplaceAll(value, {{"\\", "\\\\"}, {"\"", "\\\""}}), "\"");
}
std::string Print(bool value) { return value ? "true" : "false"; }
std::string Print(double value) {
  char text[32];  // the shortest text that reads as the same number
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}
std::string Print(int value) { return std::to_string(value); }
std::string Print(std::uint64_t value) { return std::to_string(value); }
std::string Print(Duration value) { return Print(ToSeconds(value)); }
std::string Print(SolidMode value) {
  return Print(std::string(kSolidModeNames[static_cast<std::size_t>(value)]));
}
std::string Print(MotionModel value) {
  return Print(std::string(value == MotionModel::kTrack ? "track" : "last"));
}
std::string Print(MotionFromPoints value) {
  return Print(std::string(kMotionFromPointsNames[static_cast<std::size_t>(value)]));
}
std::string Print(const Aabb& box) {
  std::vector<std::string> numbers;
  for (double number :
       {box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()}) {
    numbers.push_back(Print(number));
  }
  return absl::StrCat("[", absl::StrJoin(numbers, ", "), "]");
}
std::string Print(const std::vector<Aabb>& boxes) {
  std::vector<std::string> texts;
  for (const Aabb& box : boxes) texts.push_back(Print(box));
  return absl::StrCat("[", absl::StrJoin(texts, ", "), "]");
}

// A setting of one member; field(config) gives a reference to it.
template <class Field>
Setting Make(const char* key, const char* help, Field field) {
  return {
      key, help,
      [key = std::string(key), field](ServerConfig& config, const std::string& text) {
        const absl::Status status = Parse(text, field(config));
        if (status.ok()) return status;
        return absl::InvalidArgumentError(absl::StrCat(key, ": ", std::string(status.message())));
      },
      [field](const ServerConfig& config) {
        ServerConfig copy = config;
        return Print(field(copy));
      }};
}

#define CLEARWAY_SETTING(key, member, help) \
  Make(                                     \
      key, help, [](ServerConfig & c) -> auto& { return c.member; })

std::vector<Setting> ServerSettings() {
  return {
      CLEARWAY_SETTING("listen", listen, "address: host:port (port 0: any free one) or unix:/path"),
      CLEARWAY_SETTING("tls_cert", tls_cert, "PEM file of the server's certificate chain"),
      CLEARWAY_SETTING("tls_key", tls_key, "PEM file of its private key"),
      CLEARWAY_SETTING("log_level", log_level, "trace, debug, info, warning, error or off"),
      CLEARWAY_SETTING("threads", threads, "threads that apply frames; 0: as many as there are"),
      CLEARWAY_SETTING("writer_niceness", writer_niceness,
                       "how far answers come before frames on a busy machine: 0 to 19"),
      CLEARWAY_SETTING("kept_versions", kept_versions, "older versions kept for mirrors"),
  };
}

std::vector<Setting> SceneSettings() {
  return {
      CLEARWAY_SETTING("scene.resolution_m", scene.resolution_m, "voxel size of the static map"),
      CLEARWAY_SETTING("scene.object_resolution_m", scene.object_resolution_m,
                       "voxel size of the objects' maps"),
      CLEARWAY_SETTING("scene.probability_hit", scene.occupancy.hit, "of a hit"),
      CLEARWAY_SETTING("scene.probability_miss", scene.occupancy.miss, "of a miss"),
      CLEARWAY_SETTING("scene.clamp_min", scene.occupancy.clamp_min, "lowest probability"),
      CLEARWAY_SETTING("scene.clamp_max", scene.occupancy.clamp_max, "highest probability"),
      CLEARWAY_SETTING("scene.occupied_threshold", scene.occupancy.occupied,
                       "probability from which a voxel is occupied"),
      CLEARWAY_SETTING("scene.max_range_m", scene.rays.max_range_m, "negative: no limit"),
      CLEARWAY_SETTING("scene.discretize", scene.rays.discretize, "one ray per end voxel"),
      CLEARWAY_SETTING("scene.grazing_m", scene.rays.grazing_m,
                       "metres before its end in which a ray spares what it grazes"),
      CLEARWAY_SETTING("scene.solid", scene.solid,
                       "what an object fills: convex_hull, completed_hull or voxels"),
      CLEARWAY_SETTING("scene.clear_objects_by_rays", scene.clear_objects_by_rays,
                       "whether rays clear voxels of objects"),
      CLEARWAY_SETTING("scene.motion", scene.motion,
                       "last or track: extrapolate the last motion, or a fit of the track"),
      CLEARWAY_SETTING("scene.motion_from_points", scene.motion_from_points,
                       "auto, on or off: estimate the motion of objects that come without one "
                       "from their points; auto: of those that never had one"),
      CLEARWAY_SETTING("scene.horizon_s", scene.horizon, "how long motions are extrapolated"),
      CLEARWAY_SETTING("scene.object_lifetime_s", scene.object_lifetime,
                       "objects unseen for longer are dropped"),
      CLEARWAY_SETTING("scene.history_s", scene.history, "how far back poses are kept"),
      CLEARWAY_SETTING("scene.rest_distance_m", scene.rest_distance_m,
                       "objects that stay within it for a second are at rest"),
      CLEARWAY_SETTING("scene.object_pose_error_m", scene.object_pose_error_m,
                       "mean error of objects' poses; not 0: views are registered to maps"),
      CLEARWAY_SETTING("scene.object_pose_error_rad", scene.object_pose_error_rad,
                       "the same of their angles"),
      CLEARWAY_SETTING("scene.sensor_pose_error_m", scene.sensor_pose_error_m,
                       "mean error of the sensor's poses; not 0: scans are registered to the map"),
      CLEARWAY_SETTING("scene.sensor_pose_error_rad", scene.sensor_pose_error_rad,
                       "the same of their angles"),
      CLEARWAY_SETTING(
          "scene.reidentify", scene.reidentify,
          "lost objects are known by new ids; poses that are off need object_pose_error_m"),
      CLEARWAY_SETTING("scene.filter_labels", scene.filter_labels,
                       "whether labels that the points around contradict are left out"),
      CLEARWAY_SETTING("scene.dynamic_life_s", scene.dynamic_life,
                       "how long what long was free is occupied after a hit; 0: as all is"),
      CLEARWAY_SETTING("scene.dynamic_settle_s", scene.dynamic_settle,
                       "hit for so long, it is static"),
      CLEARWAY_SETTING(
          "scene.keep_distance_m", scene.keep_distance_m,
          "what of the static map lies farther from the sensor is forgotten; 0: nothing"),
      CLEARWAY_SETTING("scene.bounds_m", scene.bounds_W, "box: x y z of its corners"),
      CLEARWAY_SETTING("scene.keep_out_m", scene.keep_out_W, "boxes that read as occupied"),
      CLEARWAY_SETTING("scene.self_filter_m", scene.self_filter_S,
                       "boxes of the robot's own body, in the sensor frame"),
  };
}

std::vector<Setting> LimitSettings() {
  return {
#define CLEARWAY_LIMIT(name, help) CLEARWAY_SETTING("limits." #name, limits.name, help)
      CLEARWAY_LIMIT(max_message_bytes, "of a request"),
      CLEARWAY_LIMIT(max_points_per_frame, "points in a frame"),
      CLEARWAY_LIMIT(max_objects, "objects in the scene, motions and poses in a frame"),
      CLEARWAY_LIMIT(max_coordinate_m, "largest coordinate of a position"),
      CLEARWAY_LIMIT(max_blocks,
                     "blocks of 8 x 8 x 8 voxels in all maps together, of 1.3 to 3 KB each"),
      CLEARWAY_LIMIT(max_states_per_batch, "states in a check"),
      CLEARWAY_LIMIT(max_points_per_query, "points, cells, rays or poses in a query"),
      CLEARWAY_LIMIT(max_robots, "robots remembered"),
      CLEARWAY_LIMIT(max_links_per_robot, "links of a robot"),
      CLEARWAY_LIMIT(max_triangles_per_robot, "triangles of a robot"),
      CLEARWAY_LIMIT(max_voxels_per_robot, "voxels in the boxes around a robot's shapes"),
      CLEARWAY_LIMIT(max_leases, "leases held at once"),
      CLEARWAY_LIMIT(max_lease_ttl_s, "longest time to live of a lease"),
      CLEARWAY_LIMIT(max_follow_streams, "mirrors at once"),
      CLEARWAY_LIMIT(max_push_streams, "push streams at once"),
      CLEARWAY_LIMIT(max_frames_in_flight, "frames of a stream read ahead of their answers"),
      CLEARWAY_LIMIT(max_queued_frames, "frames waiting to be applied"),
      CLEARWAY_LIMIT(max_remembered_answers, "answers kept for repeated frames"),
      CLEARWAY_LIMIT(max_version_wait_s, "longest wait for a version"),
      CLEARWAY_LIMIT(max_prior_bytes, "size of a prior map's file"),
      CLEARWAY_LIMIT(max_boxes, "boxes, contacts or ids in one request"),
      CLEARWAY_LIMIT(max_calls, "calls at once"),
      CLEARWAY_LIMIT(max_plans, "plans at once"),
      CLEARWAY_LIMIT(max_planning_s, "longest time to think of a plan"),
      CLEARWAY_LIMIT(max_watch_streams, "watches of motions at once"),
#undef CLEARWAY_LIMIT
  };
}
#undef CLEARWAY_SETTING

}  // namespace

std::string Setting::FlagName() const {
  return "--" + absl::StrReplaceAll(key, {{".", "-"}, {"_", "-"}});
}

std::string Setting::EnvironmentName() const {
  return "CLEARWAY_" + absl::AsciiStrToUpper(absl::StrReplaceAll(key, {{".", "_"}}));
}

const std::vector<Setting>& Settings() {
  static const std::vector<Setting>* const kAll = [] {
    auto* all = new std::vector<Setting>(ServerSettings());
    for (const auto& part : {SceneSettings(), LimitSettings()}) {
      all->insert(all->end(), part.begin(), part.end());
    }
    return all;
  }();
  return *kAll;
}

}  // namespace clearway
