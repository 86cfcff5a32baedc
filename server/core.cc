#include "server/core.h"

#include <random>
#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kTurn(10);  // that a long call may compute while others wait

int Processors() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

std::string NewInstance() {
  std::random_device random;
  return absl::StrFormat("%08x%08x", random(), random());
}

ServerConfig WithMemoryLimit(ServerConfig config) {
  if (config.limits.max_memory_bytes == 0) config.limits.max_memory_bytes = DefaultMemoryLimit();
  return config;
}

Ingestor::Options IngestorOptions(const ServerConfig& config, const MemoryBudget& memory) {
  Ingestor::Options options;
  options.scene = config.scene;
  options.frames = FrameLimitsOf(config.limits);
  options.max_queued = config.limits.max_queued_frames;
  options.max_remembered = config.limits.max_remembered_answers;
  options.threads = config.threads > 0 ? config.threads : Processors();
  options.niceness = config.writer_niceness;
  options.has_room = [&memory] { return memory.Room(); };
  return options;
}

Leases::Options LeaseOptions(const ServerConfig& config) {
  Leases::Options options;
  options.max_leases = config.limits.max_leases;
  options.max_of_peer = PeerLimit(config.limits.max_leases, config.limits.max_peer_share);
  options.max_ttl = FromSeconds(config.limits.max_lease_ttl_s);
  return options;
}

}  // namespace

FrameLimits FrameLimitsOf(const ServerLimits& limits) {
  return {.max_points = limits.max_points_per_frame,
          .max_ray_voxels = limits.max_ray_voxels,
          .max_objects = limits.max_objects,
          .max_coordinate_m = limits.max_coordinate_m,
          .max_blocks = limits.max_blocks,
          .max_stamp_jump = FromSeconds(limits.max_stamp_jump_s),
          .late_window = FromSeconds(limits.late_window_s)};
}

ServerCore::ServerCore(const ServerConfig& server_config)
    : config(WithMemoryLimit(server_config)),
      instance(NewInstance()),
      memory(config.limits.max_memory_bytes),
      request_memory(config.limits.max_request_memory_bytes),
      versions(config.kept_versions),
      deltas(instance),
      streams(FromSeconds(config.limits.max_stall_s), FromSeconds(config.limits.max_idle_s)),
      computing(Processors(), kTurn),
      leases(LeaseOptions(config)),
      robots(config.limits, config.scene.resolution_m),
      ingestor(IngestorOptions(config, memory), versions),
      open_calls(config.limits.max_calls, config.limits.max_peer_share,
                 [this](bool room) {
                   if (on_room) on_room(room);
                 }),
      follow_streams("follow streams", config.limits.max_follow_streams,
                     config.limits.max_peer_share),
      push_streams("push streams", config.limits.max_push_streams, config.limits.max_peer_share),
      watch_streams("watches", config.limits.max_watch_streams, config.limits.max_peer_share),
      plans("plans", config.limits.max_plans, config.limits.max_peer_share) {}

absl::StatusOr<ScenePtr> ServerCore::SceneFor(const v1::SceneSelector& selector, const Gone& gone) {
  const SceneQuery query = ReadQuery(selector);
  const auto too_new = [&](std::uint64_t version) {
    return WithReason(
        absl::FailedPreconditionError(absl::StrCat("selector.min_version: is ", query.min_version,
                                                   "; the scene has version ", version)),
        "VERSION_NOT_REACHED");
  };
  if (!query.lease_id.empty()) {
    absl::StatusOr<ScenePtr> held = leases.Find(query.lease_id);
    if (held.ok() && (*held)->version < query.min_version) return too_new((*held)->version);
    return held;
  }
  const Duration patience = FromSeconds(config.limits.max_version_wait_s);
  ScenePtr scene = versions.WaitFor(query.min_version, patience, gone);
  if (scene != nullptr) return scene;
  if (gone()) return absl::CancelledError("the client has gone");
  scene = versions.Newest();  // while draining nobody waits
  if (scene->version >= query.min_version) return scene;
  return too_new(scene->version);
}

}  // namespace clearway
