// What a server says of itself.
#pragma once

#include <cstdint>
#include <string>

#include "clearway/base/time.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// What a server refuses to exceed (RESOURCE_EXHAUSTED); read with GetServerInfo. A plain value.
struct ServerLimits {
  std::uint64_t max_message_bytes = 64 << 20;
  std::uint64_t max_points_per_frame = 2'000'000;
  std::uint64_t max_ray_voxels = 1 << 29;  // that the rays of a frame or query pass, all in all
  std::uint64_t max_objects = 4'096;
  double max_coordinate_m = 100'000;
  std::uint64_t max_blocks = 1 << 22;  // of 8 x 8 x 8 voxels, in all maps of the scene
  // Of the process, when something is to be added; 0 to a server: half of the memory there is.
  std::uint64_t max_memory_bytes = 0;
  // Of requests that are being answered and replies that are not read yet, together.
  std::uint64_t max_request_memory_bytes = 1 << 30;
  std::uint64_t max_states_per_batch = 20'000;
  std::uint64_t max_points_per_query = 4'000'000;  // points, cells, rays or poses
  std::uint64_t max_robots = 64;
  std::uint64_t max_links_per_robot = 256;
  std::uint64_t max_triangles_per_robot = 500'000;
  std::uint64_t max_voxels_per_robot = 20'000'000;
  std::uint64_t max_leases = 256;
  double max_lease_ttl_s = 600;
  std::uint64_t max_follow_streams = 128;
  std::uint64_t max_push_streams = 128;
  std::uint64_t max_frames_in_flight = 8;  // of one stream
  std::uint64_t max_queued_frames = 32;
  std::uint64_t max_remembered_answers = 10'000;
  double max_version_wait_s = 5;  // below the deadline of clients, which ask for 10 s
  std::uint64_t max_prior_bytes = 1 << 30;
  std::uint64_t max_boxes = 10'000;  // keep-out boxes, declared-free boxes, contacts, ignored ids
  std::uint64_t max_connections = 1024;
  std::uint64_t max_calls = 512;  // at once
  std::uint64_t max_plans = 8;    // at once
  double max_planning_s = 60;
  std::uint64_t max_watch_streams = 64;
  double max_stall_s = 10;  // that a stream's client may read nothing of what is written to it
  double max_idle_s = 600;  // that a stream's client may write nothing
  double max_peer_share =
      0.5;  // of calls, streams, plans, robots and leases, that one client may have
  double max_stamp_jump_s = 3600;  // of a frame's stamp, ahead of the scene's newest
  double late_window_s = 0.2;      // for frames older than those of other sensors
  bool operator==(const ServerLimits&) const = default;
};

// The first part of every answer: the version it was computed on.
struct Versioned {
  std::uint64_t version = 0;
  Time stamp;  // of the version's newest frame
};

struct ServerInfo : Versioned {
  std::string software_version;
  std::string instance;  // differs for each start of a server
  ServerLimits limits;
  SceneParams params;
};

struct ServerStatus : Versioned {
  std::string scene_hash;  // if asked for
  double uptime_s = 0;
  bool draining = false;
  // Since the server started, whatever became of the scene.
  std::uint64_t frames_applied = 0, frames_refused = 0;
  std::uint64_t frames_late = 0;  // of those applied
  std::uint64_t points_used = 0, points_not_finite = 0;

  std::uint64_t queued_frames = 0;
  std::uint64_t objects = 0;
  std::uint64_t static_observed_voxels = 0, static_occupied_voxels = 0;
  Aabb static_box_W;  // around the observed blocks
  std::uint64_t robots = 0, leases = 0, follow_streams = 0, push_streams = 0, watch_streams = 0;
  // Of the server's process: what is in memory, and what its heap has handed out, touched or not.
  std::uint64_t resident_bytes = 0, heap_bytes_in_use = 0;
};

}  // namespace clearway
