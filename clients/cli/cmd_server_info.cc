// clearway server-info: a server's version, parameters and limits.
#include <memory>

#include "absl/strings/ascii.h"
#include "clearway/client/scene_client.h"
#include "clearway/report/table.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/server_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway server-info\n"
    "  clearway server-info --json | jq .limits.max_points_per_frame";

struct Flags {
  ServerFlags server;
  bool json = false;
};

Json LimitsJson(const ServerLimits& l) {
  return {{"max_message_bytes", l.max_message_bytes},
          {"max_points_per_frame", l.max_points_per_frame},
          {"max_ray_voxels", l.max_ray_voxels},
          {"max_objects", l.max_objects},
          {"max_coordinate_m", l.max_coordinate_m},
          {"max_blocks", l.max_blocks},
          {"max_states_per_batch", l.max_states_per_batch},
          {"max_points_per_query", l.max_points_per_query},
          {"max_robots", l.max_robots},
          {"max_links_per_robot", l.max_links_per_robot},
          {"max_triangles_per_robot", l.max_triangles_per_robot},
          {"max_voxels_per_robot", l.max_voxels_per_robot},
          {"max_leases", l.max_leases},
          {"max_lease_ttl_s", l.max_lease_ttl_s},
          {"max_follow_streams", l.max_follow_streams},
          {"max_push_streams", l.max_push_streams},
          {"max_frames_in_flight", l.max_frames_in_flight},
          {"max_queued_frames", l.max_queued_frames},
          {"max_remembered_answers", l.max_remembered_answers},
          {"max_version_wait_s", l.max_version_wait_s},
          {"max_prior_bytes", l.max_prior_bytes},
          {"max_boxes", l.max_boxes},
          {"max_calls", l.max_calls},
          {"max_plans", l.max_plans},
          {"max_planning_s", l.max_planning_s},
          {"max_watch_streams", l.max_watch_streams},
          {"max_stall_s", l.max_stall_s},
          {"max_connections", l.max_connections},
          {"max_memory_bytes", l.max_memory_bytes},
          {"max_request_memory_bytes", l.max_request_memory_bytes},
          {"max_idle_s", l.max_idle_s},
          {"max_peer_share", l.max_peer_share},
          {"max_stamp_jump_s", l.max_stamp_jump_s},
          {"late_window_s", l.late_window_s}};
}

Json ParamsJson(const SceneParams& p) {
  return {{"resolution_m", p.resolution_m},
          {"object_resolution_m", p.object_resolution_m},
          {"hit_probability", p.occupancy.hit},
          {"miss_probability", p.occupancy.miss},
          {"clamp_min_probability", p.occupancy.clamp_min},
          {"clamp_max_probability", p.occupancy.clamp_max},
          {"occupied_probability", p.occupancy.occupied},
          {"max_range_m", p.rays.max_range_m},
          {"discretize", p.rays.discretize},
          {"octomap_ends", p.rays.octomap_ends},
          {"grazing_m", p.rays.grazing_m},
          {"solid",
           absl::AsciiStrToUpper(std::string(kSolidModeNames[static_cast<std::size_t>(p.solid)]))},
          {"clear_objects_by_rays", p.clear_objects_by_rays},
          {"motion", p.motion == MotionModel::kTrack ? "TRACK" : "LAST_MOTION"},
          {"motion_from_points",
           absl::AsciiStrToUpper(std::string(
               kMotionFromPointsNames[static_cast<std::size_t>(p.motion_from_points)]))},
          {"horizon_s", ToSeconds(p.horizon)},
          {"object_lifetime_s", ToSeconds(p.object_lifetime)},
          {"history_s", ToSeconds(p.history)},
          {"rest_distance_m", p.rest_distance_m},
          {"object_pose_error_m", p.object_pose_error_m},
          {"object_pose_error_rad", p.object_pose_error_rad},
          {"sensor_pose_error_m", p.sensor_pose_error_m},
          {"sensor_pose_error_rad", p.sensor_pose_error_rad},
          {"reidentify", p.reidentify},
          {"filter_labels", p.filter_labels},
          {"dynamic_life_s", ToSeconds(p.dynamic_life)},
          {"dynamic_settle_s", ToSeconds(p.dynamic_settle)},
          {"keep_distance_m", p.keep_distance_m},
          {"bounds_world", ToJson(p.bounds_W)},
          {"keep_out_boxes", p.keep_out_W.size()},
          {"self_filter_boxes", p.self_filter_S.size()}};
}

void PrintSection(std::ostream& out, const std::string& title, const Json& section) {
  Table table({title, "value"});
  for (const auto& [name, value] : section.items()) {
    table.AddRow({name, value.is_string() ? value.get<std::string>() : value.dump()});
  }
  out << "\n" << table.ToString();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const auto info = SceneClient(*connection).GetServerInfo();
  if (!info.ok()) return info.status();
  const Json params = ParamsJson(info->params), limits = LimitsJson(info->limits);
  if (flags.json) {
    Print(terminal.out, {{"version", info->software_version},
                         {"instance", info->instance},
                         {"params", params},
                         {"limits", limits}});
    return absl::OkStatus();
  }
  terminal.out << "clearway-server " << info->software_version << " at " << flags.server.address
               << ", instance " << info->instance << "\n";
  PrintSection(terminal.out, "scene parameter", params);
  PrintSection(terminal.out, "limit", limits);
  return absl::OkStatus();
}

}  // namespace

void AddServerInfo(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "server-info", "Show the server's version, parameters and limits", kExamples,
                 [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
