#include <algorithm>
#include <thread>

#include "clearway/scene/scene_delta.h"
#include "server/handler.h"
#include "server/services.h"
#include "wire/delta_wire.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kLook(20);
constexpr double kMaxInterval_s = 3600;

// Waits, unless the client goes or the server drains.
void Pause(Duration time, const ServerCore& core, const Gone& gone) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!core.draining && !gone()) {
    const auto left = end - std::chrono::steady_clock::now();
    if (left <= Duration::zero()) return;
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(left, kLook));
  }
}

// One difference to the newest version at a time: a client that reads slowly blocks Write, and what
// was published meanwhile becomes one difference. Nothing queues up.
absl::Status Follow(ServerCore& core, ScenePtr base, Duration min_interval, MapDetail detail,
                    const Gone& gone, grpc::ServerWriter<v1::FollowSceneResponse>& writer) {
  while (!gone()) {
    const std::uint64_t wanted = base == nullptr ? 0 : base->version + 1;
    const ScenePtr next = core.versions.WaitFor(wanted, std::chrono::seconds(1), gone);
    if (core.draining)
      return WithReason(absl::UnavailableError("the server is draining"), "DRAINING");
    if (next == nullptr) continue;
    const auto send = [&](const v1::SceneDeltaPart& part) {
      v1::FollowSceneResponse response;
      Write(VersionOf(*next), response.mutable_scene());
      response.set_server_instance(core.instance);
      *response.mutable_delta() = part;
      return writer.Write(response);
    };
    if (!WriteDelta(Diff(base.get(), *next, detail), send)) break;
    base = next;
    Pause(min_interval, core, gone);
  }
  return absl::CancelledError("the client has gone");
}

}  // namespace

grpc::Status FollowHandlers::FollowScene(grpc::ServerContext* context,
                                         const v1::FollowSceneRequest* request,
                                         grpc::ServerWriter<v1::FollowSceneResponse>* writer) {
  return Handle(core_, "FollowScene", *request, [&]() -> absl::Status {
    const std::uint64_t limit = core_.config.limits.max_follow_streams;
    const Slot slot(core_.follow_streams, limit);
    if (!slot.ok()) return TooMany("follow streams", limit);
    FieldReader read;
    const double interval_s = read.NotNegative("min_interval_s", request->min_interval_s());
    if (!read.ok()) return read.status();
    const bool ours = request->server_instance() == core_.instance;
    ScenePtr base = request->has_from_version() && ours
                        ? core_.versions.Find(request->from_version())
                        : nullptr;
    const MapDetail detail = request->states_only() ? MapDetail::kStates : MapDetail::kLogOdds;
    return Follow(core_, std::move(base), FromSeconds(std::min(interval_s, kMaxInterval_s)), detail,
                  GoneOf(context), *writer);
  });
}

}  // namespace clearway
