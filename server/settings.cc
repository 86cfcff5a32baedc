// The table of all keys.
#include <cmath>
#include <limits>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "server/config.h"
#include "server/setting_values.h"

namespace clearway {
namespace {

// What a number may be.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool with_ends = true;
};

// Of the text of a number, before it is converted to a type that may not hold it. Other texts pass.
absl::Status CheckRange(const std::string& key, const std::string& text, const Range& range) {
  double value = 0;
  if (!ParseBlankedNumber(text, value) || std::isnan(value)) return absl::OkStatus();
  if (range.with_ends ? value >= range.min && value <= range.max
                      : value > range.min && value < range.max) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat(
      key, ": is ", text, range.with_ends ? "; it must lie between " : "; it must be above ",
      ValueText(range.min), range.with_ends ? " and " : " and below ", ValueText(range.max)));
}

// A setting of one member; field(config) gives a reference to it.
template <class Field>
Setting Make(const char* key_text, const char* help, Field field, const Range& range = {}) {
  const std::string key = key_text;
  const auto get = [field](const ServerConfig& config) {
    ServerConfig copy = config;
    return ValueText(field(copy));
  };
  const auto set = [key, field, range](ServerConfig& config, const std::string& text) {
    if (absl::Status status = CheckRange(key, text, range); !status.ok()) return status;
    const absl::Status status = ParseValue(text, field(config));
    if (status.ok()) return status;
    return absl::InvalidArgumentError(absl::StrCat(key, ": ", std::string(status.message())));
  };
  const auto check = [key, get, range](const ServerConfig& config) {
    return CheckRange(key, get(config), range);
  };
  return {key, help, set, get, check};
}

#define CLEARWAY_SETTING(key, member, help, ...) \
  Make(                                          \
      key, help, [](ServerConfig & c) -> auto& { return c.member; } __VA_OPT__(, ) __VA_ARGS__)

std::vector<Setting> ServerSettings() {
  return {
      CLEARWAY_SETTING("listen", listen, "address: host:port (port 0: any free one) or unix:/path"),
      CLEARWAY_SETTING("tls_cert", tls_cert, "PEM file of the server's certificate chain"),
      CLEARWAY_SETTING("tls_key", tls_key, "PEM file of its private key"),
      CLEARWAY_SETTING("tls_client_ca", tls_client_ca,
                       "PEM file of the authorities whose certificates clients must show"),
      CLEARWAY_SETTING("tokens", tokens,
                       "file of who may do what ('clearway token'); none: everybody everything"),
      CLEARWAY_SETTING("insecure", insecure,
                       "listen without TLS where others than this machine can connect"),
      CLEARWAY_SETTING("socket_mode", socket_mode, "permissions of a Unix socket, in octal"),
      CLEARWAY_SETTING("reflection", reflection,
                       "tell clients such as grpcurl what services there are"),
      CLEARWAY_SETTING("log_level", log_level, "trace, debug, info, warning, error or off"),
      CLEARWAY_SETTING("threads", threads, "threads that apply frames; 0: as many as there are",
                       Range{0, 256}),
      CLEARWAY_SETTING("writer_niceness", writer_niceness,
                       "how far answers come before frames on a busy machine: 0 to 19",
                       Range{0, 19}),
      CLEARWAY_SETTING("kept_versions", kept_versions, "older versions kept for mirrors",
                       Range{0, 10'000}),
      CLEARWAY_SETTING("drain_s", drain,
                       "seconds that calls and accepted frames have to end after SIGTERM",
                       (Range{0, 600})),
      CLEARWAY_SETTING("keepalive.time_s", keepalive.time,
                       "seconds without a sign of a client before the server pings it",
                       (Range{1, 3600})),
      CLEARWAY_SETTING("keepalive.timeout_s", keepalive.timeout,
                       "seconds for the answer, else the connection is dropped", (Range{1, 600})),
      CLEARWAY_SETTING("keepalive.min_client_ping_s", keepalive.min_client_ping,
                       "clients that ping more often are disconnected, in seconds",
                       (Range{0.1, 3600})),
  };
}

// What Validate(SceneParams) says of single values, said at once and by their keys.
constexpr Range kVoxel_m{0.001, 100}, kUpToADay_s{0, 86'400};
constexpr Range kProbability{0.0004, 0.9996, false}, kUnlikely{0.0004, 0.5, false},
    kLikely{0.5, 0.9996, false};

std::vector<Setting> SceneSettings() {
  return {
      CLEARWAY_SETTING("scene.resolution_m", scene.resolution_m, "voxel size of the static map",
                       kVoxel_m),
      CLEARWAY_SETTING("scene.object_resolution_m", scene.object_resolution_m,
                       "voxel size of the objects' maps", kVoxel_m),
      CLEARWAY_SETTING("scene.probability_hit", scene.occupancy.hit, "of a hit", kLikely),
      CLEARWAY_SETTING("scene.probability_miss", scene.occupancy.miss, "of a miss", kUnlikely),
      CLEARWAY_SETTING("scene.clamp_min", scene.occupancy.clamp_min, "lowest probability",
                       kUnlikely),
      CLEARWAY_SETTING("scene.clamp_max", scene.occupancy.clamp_max, "highest probability",
                       kLikely),
      CLEARWAY_SETTING("scene.occupied_threshold", scene.occupancy.occupied,
                       "probability from which a voxel is occupied", kProbability),
      CLEARWAY_SETTING("scene.max_range_m", scene.rays.max_range_m, "negative: no limit"),
      CLEARWAY_SETTING("scene.discretize", scene.rays.discretize, "one ray per end voxel"),
      CLEARWAY_SETTING("scene.grazing_m", scene.rays.grazing_m,
                       "metres before its end in which a ray spares what it grazes",
                       (Range{0, 100})),
      CLEARWAY_SETTING("scene.octomap_ends", scene.rays.octomap_ends,
                       "rays without a hit leave the voxel of their end as it is, as in OctoMap"),
      CLEARWAY_SETTING("scene.solid", scene.solid,
                       "what an object fills: convex_hull, completed_hull or voxels"),
      CLEARWAY_SETTING("scene.clear_objects_by_rays", scene.clear_objects_by_rays,
                       "whether rays clear voxels of objects"),
      CLEARWAY_SETTING("scene.motion", scene.motion,
                       "last or track: extrapolate the last motion, or a fit of the track"),
      CLEARWAY_SETTING("scene.motion_from_points", scene.motion_from_points,
                       "auto, on or off: estimate the motion of objects that come without one "
                       "from their points (z of the world must point up); auto: of those "
                       "that never had one, or none for 0.6 s"),
      CLEARWAY_SETTING("scene.horizon_s", scene.horizon, "how long motions are extrapolated",
                       kUpToADay_s),
      CLEARWAY_SETTING("scene.object_lifetime_s", scene.object_lifetime,
                       "objects unseen for longer are dropped", kUpToADay_s),
      CLEARWAY_SETTING("scene.history_s", scene.history, "how far back poses are kept",
                       kUpToADay_s),
      CLEARWAY_SETTING("scene.rest_distance_m", scene.rest_distance_m,
                       "objects that stay within it for a second are at rest", (Range{0, 10})),
      CLEARWAY_SETTING("scene.object_pose_error_m", scene.object_pose_error_m,
                       "mean error of objects' poses; not 0: views are registered to maps",
                       (Range{0, 10})),
      CLEARWAY_SETTING("scene.object_pose_error_rad", scene.object_pose_error_rad,
                       "the same of their angles", (Range{0, 1})),
      CLEARWAY_SETTING("scene.sensor_pose_error_m", scene.sensor_pose_error_m,
                       "mean error of the sensor's poses; not 0: scans are registered to the map",
                       (Range{0, 10})),
      CLEARWAY_SETTING("scene.sensor_pose_error_rad", scene.sensor_pose_error_rad,
                       "the same of their angles", (Range{0, 1})),
      CLEARWAY_SETTING(
          "scene.reidentify", scene.reidentify,
          "lost objects are known by new ids; poses that are off need object_pose_error_m"),
      CLEARWAY_SETTING("scene.filter_labels", scene.filter_labels,
                       "whether labels that the points around contradict are left out"),
      CLEARWAY_SETTING("scene.dynamic_life_s", scene.dynamic_life,
                       "how long what long was free is occupied after a hit; 0: as all is",
                       kUpToADay_s),
      CLEARWAY_SETTING("scene.dynamic_settle_s", scene.dynamic_settle,
                       "hit for so long, it is static", kUpToADay_s),
      CLEARWAY_SETTING(
          "scene.keep_distance_m", scene.keep_distance_m,
          "what of the static map lies farther from the sensor is forgotten; 0: nothing",
          (Range{0, 1e9})),
      CLEARWAY_SETTING("scene.bounds_m", scene.bounds_W, "box: x y z of its corners"),
      CLEARWAY_SETTING("scene.keep_out_m", scene.keep_out_W, "boxes that read as occupied"),
      CLEARWAY_SETTING("scene.self_filter_m", scene.self_filter_S,
                       "boxes of the robot's own body, in the sensor frame"),
  };
}

// Of counts that only memory bounds.
constexpr Range kCount{1, 1e9};
// Of what takes a thread or a stream each.
constexpr Range kAtOnce{1, 65'536};
constexpr Range kSeconds{1e-3, 1e6};

std::vector<Setting> LimitSettings() {
  return {
#define CLEARWAY_LIMIT(name, range, help) \
  CLEARWAY_SETTING("limits." #name, limits.name, help, range)
      // gRPC counts bytes in an int, and refuses twice as much by itself.
      CLEARWAY_LIMIT(max_message_bytes, (Range{1, 1 << 30}), "of a request"),
      CLEARWAY_LIMIT(max_points_per_frame, kCount, "points in a frame"),
      CLEARWAY_LIMIT(max_ray_voxels, (Range{1, 1e15}),
                     "voxels that the rays of a frame or query pass, all in all"),
      CLEARWAY_LIMIT(max_objects, kCount, "objects in the scene, motions and poses in a frame"),
      // Mirrors refuse scenes that reach further than 1e6 m.
      CLEARWAY_LIMIT(max_coordinate_m, (Range{1e-3, 1e6}), "largest coordinate of a position"),
      CLEARWAY_LIMIT(max_blocks, kCount,
                     "blocks of 8 x 8 x 8 voxels in all maps together, of 1.3 to 3 KB each"),
      CLEARWAY_LIMIT(max_memory_bytes, (Range{0, 1e15}),
                     "memory in use; 0: half of the machine's or of the control group's"),
      CLEARWAY_LIMIT(max_request_memory_bytes, (Range{1, 1e15}),
                     "memory of requests that are being answered and replies not read yet"),
      CLEARWAY_LIMIT(max_states_per_batch, kCount, "states in a check"),
      CLEARWAY_LIMIT(max_points_per_query, kCount, "points, cells, rays or poses in a query"),
      CLEARWAY_LIMIT(max_robots, kCount, "robots remembered"),
      CLEARWAY_LIMIT(max_links_per_robot, kCount, "links of a robot"),
      CLEARWAY_LIMIT(max_triangles_per_robot, kCount, "triangles of a robot"),
      CLEARWAY_LIMIT(max_voxels_per_robot, (Range{1, 1e12}),
                     "voxels in the boxes around a robot's shapes"),
      CLEARWAY_LIMIT(max_leases, kCount, "leases held at once"),
      CLEARWAY_LIMIT(max_lease_ttl_s, kSeconds, "longest time to live of a lease"),
      CLEARWAY_LIMIT(max_follow_streams, kAtOnce, "mirrors at once"),
      CLEARWAY_LIMIT(max_push_streams, kAtOnce, "push streams at once"),
      CLEARWAY_LIMIT(max_frames_in_flight, kAtOnce,
                     "frames of a stream read ahead of their answers"),
      CLEARWAY_LIMIT(max_queued_frames, kCount, "frames waiting to be applied"),
      CLEARWAY_LIMIT(max_remembered_answers, kCount, "answers kept for repeated frames"),
      CLEARWAY_LIMIT(max_version_wait_s, kSeconds, "longest wait for a version"),
      CLEARWAY_LIMIT(max_prior_bytes, (Range{1, 1e12}), "size of a prior map's file"),
      CLEARWAY_LIMIT(max_boxes, kCount, "boxes, contacts or ids in one request"),
      CLEARWAY_LIMIT(max_connections, (Range{1, 1e6}), "connections at once"),
      CLEARWAY_LIMIT(max_calls, kAtOnce, "calls at once"),
      CLEARWAY_LIMIT(max_plans, kAtOnce, "plans at once"),
      CLEARWAY_LIMIT(max_planning_s, kSeconds, "longest time to think of a plan"),
      CLEARWAY_LIMIT(max_watch_streams, kAtOnce, "watches of motions at once"),
      CLEARWAY_LIMIT(max_stall_s, (Range{0.1, 3600}),
                     "how long a stream's client may read nothing of what is written to it"),
      CLEARWAY_LIMIT(max_idle_s, (Range{0.1, 1e6}),
                     "how long a stream's client may write nothing before the stream ends"),
      CLEARWAY_LIMIT(max_peer_share, (Range{1e-6, 1}),
                     "of calls, streams, plans, robots and leases, that one client may have"),
      CLEARWAY_LIMIT(max_stamp_jump_s, (Range{1e-3, 1e9}),
                     "how far a frame's stamp may lie after the scene's newest"),
      CLEARWAY_LIMIT(late_window_s, (Range{0, 10}),
                     "how late a frame may be, if newer ones came from other sensors"),
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
