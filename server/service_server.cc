#include "server/handler.h"
#include "server/memory_use.h"
#include "server/queries.h"
#include "server/services.h"
#include "wire/server_wire.h"

namespace clearway {

grpc::Status InfoHandlers::GetServerInfo(grpc::ServerContext* context,
                                         const v1::GetServerInfoRequest* request,
                                         v1::GetServerInfoResponse* response) {
  return HandleUnary(core_, context, "GetServerInfo", *request, *response, [&] {
    const ScenePtr scene = core_.versions.Newest();
    const ServerInfo info{VersionOf(*scene), CLEARWAY_VERSION, core_.instance, core_.config.limits,
                          scene->params};
    Write(info, response);
    return absl::OkStatus();
  });
}

grpc::Status InfoHandlers::GetStatus(grpc::ServerContext* context,
                                     const v1::GetStatusRequest* request,
                                     v1::GetStatusResponse* response) {
  return HandleUnary(core_, context, "GetStatus", *request, *response, [&]() -> absl::Status {
    const Gone must_end = WorkOf(core_, context);
    const ScenePtr scene = core_.versions.Newest();
    const IngestCounts counts = core_.ingestor.counts();
    ServerStatus status;
    static_cast<Versioned&>(status) = VersionOf(*scene);
    if (request->include_hash()) status.scene_hash = scene->Hash(must_end);
    if (must_end()) return absl::CancelledError("the client has gone");
    status.uptime_s = ToSeconds(std::chrono::steady_clock::now() - core_.started);
    status.draining = core_.draining;
    status.frames_applied = counts.frames_applied;
    status.frames_refused = counts.frames_refused;
    status.frames_late = counts.frames_late;
    status.points_used = counts.points_used;
    status.points_not_finite = counts.points_not_finite;
    status.queued_frames = counts.queued;
    status.objects = scene->objects.size();
    status.static_observed_voxels = scene->static_map_W.observed_count();
    status.static_occupied_voxels = scene->static_map_W.occupied_count();
    status.static_box_W = BoxAroundBlocks(scene->static_map_W);
    status.robots = core_.robots.size();
    status.leases = core_.leases.size();
    status.follow_streams = core_.follow_streams.size();
    status.push_streams = core_.push_streams.size();
    status.watch_streams = core_.watch_streams.size();
    const MemoryUse memory = CurrentMemoryUse();
    status.resident_bytes = memory.resident_bytes;
    status.heap_bytes_in_use = memory.heap_bytes_in_use;
    Write(status, response);
    return absl::OkStatus();
  });
}

}  // namespace clearway
