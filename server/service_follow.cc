#include <algorithm>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_delta.h"
#include "server/handler.h"
#include "server/services.h"
#include "wire/delta_wire.h"

namespace clearway {
namespace {

constexpr std::chrono::milliseconds kLook(20);
constexpr std::chrono::seconds kMaxWait(1);
constexpr double kMaxInterval_s = 3600;
constexpr double kMinHeartbeat_s = 0.1;

// Waits, unless the client goes or the server drains.
void Pause(Duration time, const ServerCore& core, const Gone& gone) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (!core.draining && !gone()) {
    const auto left = end - std::chrono::steady_clock::now();
    if (left <= Duration::zero()) return;
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(left, kLook));
  }
}

// What a client follows.
struct Pursuit {
  ScenePtr base;  // the version that the client has
  Duration min_interval;
  Duration heartbeat;  // zero: none
  MapDetail detail;
};

v1::FollowSceneResponse About(const SceneSnapshot& scene, const ServerCore& core) {
  v1::FollowSceneResponse response;
  Write(VersionOf(scene), response.mutable_scene());
  response.set_server_instance(core.instance);
  return response;
}

// One difference to the newest version at a time: a client that reads slowly blocks Write, and what
// was published meanwhile becomes one difference. Nothing queues up.
absl::Status Follow(ServerCore& core, Pursuit pursuit, const Gone& gone,
                    grpc::ServerWriter<v1::FollowSceneResponse>& writer) {
  using Clock = std::chrono::steady_clock;
  const Duration beat = pursuit.heartbeat;
  ScenePtr& base = pursuit.base;
  Clock::time_point next_beat = Clock::now();
  while (!gone()) {
    const std::uint64_t wanted = base == nullptr ? 0 : base->version + 1;
    const Duration quiet =
        beat == Duration::zero() ? Duration(kMaxWait) : Duration(next_beat - Clock::now());
    const ScenePtr next = core.versions.WaitFor(wanted, std::min<Duration>(quiet, kMaxWait), gone);
    if (core.draining)
      return WithReason(absl::UnavailableError("the server is draining"), "DRAINING");
    if (next == nullptr) {
      if (beat == Duration::zero() || base == nullptr || Clock::now() < next_beat) continue;
      if (!writer.Write(About(*base, core))) break;
      next_beat = Clock::now() + beat;
      continue;
    }
    const auto send = [&](const v1::SceneDeltaPart& part) {
      v1::FollowSceneResponse response = About(*next, core);
      *response.mutable_delta() = part;
      return writer.Write(response);
    };
    if (!WriteDelta(Diff(base.get(), *next, pursuit.detail), send)) break;
    base = next;
    next_beat = Clock::now() + beat;
    Pause(pursuit.min_interval, core, gone);
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
    const double beat_s = read.NotNegative("heartbeat_s", request->heartbeat_s());
    if (beat_s != 0 && !(beat_s >= kMinHeartbeat_s && beat_s <= kMaxInterval_s)) {
      read.Fail("heartbeat_s", absl::StrCat("is ", beat_s, "; it must be 0, or lie between ",
                                            kMinHeartbeat_s, " and ", kMaxInterval_s));
    }
    if (!read.ok()) return read.status();
    const bool ours = request->server_instance() == core_.instance;
    ScenePtr base = request->has_from_version() && ours
                        ? core_.versions.Find(request->from_version())
                        : nullptr;
    const MapDetail detail = request->states_only() ? MapDetail::kStates : MapDetail::kLogOdds;
    Pursuit pursuit{std::move(base), FromSeconds(std::min(interval_s, kMaxInterval_s)),
                    FromSeconds(beat_s), detail};
    return Follow(core_, std::move(pursuit), GoneOf(context), *writer);
  });
}

}  // namespace clearway
