#include "wire/server_wire.h"

#include "wire/scene_wire.h"

namespace clearway {
namespace {

void Write(const ServerLimits& limits, v1::Limits* proto) {
  proto->set_max_message_bytes(limits.max_message_bytes);
  proto->set_max_points_per_frame(limits.max_points_per_frame);
  proto->set_max_ray_voxels(limits.max_ray_voxels);
  proto->set_max_objects(limits.max_objects);
  proto->set_max_coordinate_m(limits.max_coordinate_m);
  proto->set_max_blocks(limits.max_blocks);
  proto->set_max_states_per_batch(limits.max_states_per_batch);
  proto->set_max_points_per_query(limits.max_points_per_query);
  proto->set_max_robots(limits.max_robots);
  proto->set_max_links_per_robot(limits.max_links_per_robot);
  proto->set_max_triangles_per_robot(limits.max_triangles_per_robot);
  proto->set_max_voxels_per_robot(limits.max_voxels_per_robot);
  proto->set_max_leases(limits.max_leases);
  proto->set_max_lease_ttl_s(limits.max_lease_ttl_s);
  proto->set_max_follow_streams(limits.max_follow_streams);
  proto->set_max_push_streams(limits.max_push_streams);
  proto->set_max_frames_in_flight(limits.max_frames_in_flight);
  proto->set_max_queued_frames(limits.max_queued_frames);
  proto->set_max_remembered_answers(limits.max_remembered_answers);
  proto->set_max_version_wait_s(limits.max_version_wait_s);
  proto->set_max_prior_bytes(limits.max_prior_bytes);
  proto->set_max_boxes(limits.max_boxes);
  proto->set_max_calls(limits.max_calls);
  proto->set_max_plans(limits.max_plans);
  proto->set_max_planning_s(limits.max_planning_s);
  proto->set_max_watch_streams(limits.max_watch_streams);
  proto->set_max_stall_s(limits.max_stall_s);
  proto->set_max_connections(limits.max_connections);
  proto->set_max_memory_bytes(limits.max_memory_bytes);
  proto->set_max_request_memory_bytes(limits.max_request_memory_bytes);
  proto->set_max_idle_s(limits.max_idle_s);
  proto->set_max_peer_share(limits.max_peer_share);
  proto->set_max_stamp_jump_s(limits.max_stamp_jump_s);
  proto->set_late_window_s(limits.late_window_s);
}

ServerLimits ReadLimits(const v1::Limits& proto) {
  ServerLimits limits;
  limits.max_message_bytes = proto.max_message_bytes();
  limits.max_points_per_frame = proto.max_points_per_frame();
  limits.max_ray_voxels = proto.max_ray_voxels();
  limits.max_objects = proto.max_objects();
  limits.max_coordinate_m = proto.max_coordinate_m();
  limits.max_blocks = proto.max_blocks();
  limits.max_states_per_batch = proto.max_states_per_batch();
  limits.max_points_per_query = proto.max_points_per_query();
  limits.max_robots = proto.max_robots();
  limits.max_links_per_robot = proto.max_links_per_robot();
  limits.max_triangles_per_robot = proto.max_triangles_per_robot();
  limits.max_voxels_per_robot = proto.max_voxels_per_robot();
  limits.max_leases = proto.max_leases();
  limits.max_lease_ttl_s = proto.max_lease_ttl_s();
  limits.max_follow_streams = proto.max_follow_streams();
  limits.max_push_streams = proto.max_push_streams();
  limits.max_frames_in_flight = proto.max_frames_in_flight();
  limits.max_queued_frames = proto.max_queued_frames();
  limits.max_remembered_answers = proto.max_remembered_answers();
  limits.max_version_wait_s = proto.max_version_wait_s();
  limits.max_prior_bytes = proto.max_prior_bytes();
  limits.max_boxes = proto.max_boxes();
  limits.max_calls = proto.max_calls();
  limits.max_plans = proto.max_plans();
  limits.max_planning_s = proto.max_planning_s();
  limits.max_watch_streams = proto.max_watch_streams();
  limits.max_stall_s = proto.max_stall_s();
  limits.max_connections = proto.max_connections();
  limits.max_memory_bytes = proto.max_memory_bytes();
  limits.max_request_memory_bytes = proto.max_request_memory_bytes();
  limits.max_idle_s = proto.max_idle_s();
  limits.max_peer_share = proto.max_peer_share();
  limits.max_stamp_jump_s = proto.max_stamp_jump_s();
  limits.late_window_s = proto.late_window_s();
  return limits;
}

}  // namespace

void Write(const ServerInfo& info, v1::GetServerInfoResponse* proto) {
  Write(static_cast<const Versioned&>(info), proto->mutable_scene());
  proto->set_software_version(info.software_version);
  proto->set_server_instance(info.instance);
  Write(info.limits, proto->mutable_limits());
  Write(info.params, proto->mutable_params());
}

absl::StatusOr<ServerInfo> ReadServerInfo(const v1::GetServerInfoResponse& proto) {
  absl::StatusOr<SceneParams> params = ReadSceneParams("params", proto.params());
  if (!params.ok()) return params.status();
  ServerInfo info;
  static_cast<Versioned&>(info) = ReadVersion(proto.scene());
  info.software_version = proto.software_version();
  info.instance = proto.server_instance();
  info.limits = ReadLimits(proto.limits());
  info.params = *std::move(params);
  return info;
}

void Write(const ServerStatus& status, v1::GetStatusResponse* proto) {
  Write(static_cast<const Versioned&>(status), proto->mutable_scene());
  proto->set_scene_hash(status.scene_hash);
  proto->set_uptime_s(status.uptime_s);
  proto->set_draining(status.draining);
  proto->set_frames_applied(status.frames_applied);
  proto->set_frames_refused(status.frames_refused);
  proto->set_frames_late(status.frames_late);
  proto->set_points_used(status.points_used);
  proto->set_points_not_finite(status.points_not_finite);
  proto->set_queued_frames(status.queued_frames);
  proto->set_objects(status.objects);
  proto->set_static_observed_voxels(status.static_observed_voxels);
  proto->set_static_occupied_voxels(status.static_occupied_voxels);
  proto->set_robots(status.robots);
  proto->set_leases(status.leases);
  proto->set_follow_streams(status.follow_streams);
  proto->set_push_streams(status.push_streams);
  proto->set_watch_streams(status.watch_streams);
  proto->set_resident_bytes(status.resident_bytes);
  proto->set_heap_bytes_in_use(status.heap_bytes_in_use);
  if (!status.static_box_W.Empty()) Write(status.static_box_W, proto->mutable_static_box_world());
}

absl::StatusOr<ServerStatus> ReadServerStatus(const v1::GetStatusResponse& proto) {
  ServerStatus status;
  static_cast<Versioned&>(status) = ReadVersion(proto.scene());
  status.scene_hash = proto.scene_hash();
  status.uptime_s = proto.uptime_s();
  status.draining = proto.draining();
  status.frames_applied = proto.frames_applied();
  status.frames_refused = proto.frames_refused();
  status.frames_late = proto.frames_late();
  status.points_used = proto.points_used();
  status.points_not_finite = proto.points_not_finite();
  status.queued_frames = proto.queued_frames();
  status.objects = proto.objects();
  status.static_observed_voxels = proto.static_observed_voxels();
  status.static_occupied_voxels = proto.static_occupied_voxels();
  status.robots = proto.robots();
  status.leases = proto.leases();
  status.follow_streams = proto.follow_streams();
  status.push_streams = proto.push_streams();
  status.watch_streams = proto.watch_streams();
  status.resident_bytes = proto.resident_bytes();
  status.heap_bytes_in_use = proto.heap_bytes_in_use();
  if (!proto.has_static_box_world()) return status;
  FieldReader read;
  status.static_box_W = read.Box("static_box_world", true, proto.static_box_world());
  if (!read.ok()) return read.status();
  return status;
}

}  // namespace clearway
