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
constexpr std::size_t kMostSharedBlocks = 100'000;  // of a scene: some 30 MB as messages

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

// One difference to the newest version at a time: a client that reads slowly blocks the write, and
// what was published meanwhile becomes one difference. Nothing queues up.
class Follower {
 public:
  Follower(ServerCore& core, Pursuit pursuit, grpc::ServerContext& context,
           grpc::ServerWriter<v1::FollowSceneResponse>& writer)
      : core_(core),
        pursuit_(std::move(pursuit)),
        context_(context),
        writer_(writer),
        gone_(GoneOf(core, &context)) {}

  absl::Status Run() {
    ScenePtr& base = pursuit_.base;
    const Duration beat = pursuit_.heartbeat;
    Clock::time_point next_beat = Clock::now();
    while (!gone_()) {
      const std::uint64_t wanted = base == nullptr ? 0 : base->version + 1;
      const Duration quiet =
          beat == Duration::zero() ? Duration(kMaxWait) : Duration(next_beat - Clock::now());
      const ScenePtr next =
          core_.versions.WaitFor(wanted, std::min<Duration>(quiet, kMaxWait), gone_);
      if (core_.draining) return DrainingError();
      if (next == nullptr) {
        if (beat == Duration::zero() || base == nullptr || Clock::now() < next_beat) continue;
        if (!Send(AboutVersion(*base, core_.instance))) break;
        next_beat = Clock::now() + beat;
        continue;
      }
      if (!SendDifference(*next)) break;
      base = next;
      next_beat = Clock::now() + beat;
      Pause(pursuit_.min_interval, core_, gone_);
    }
    return absl::CancelledError("the client has gone");
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool Send(const v1::FollowSceneResponse& message) {
    return WriteTo(writer_, message, context_, core_.streams);
  }

  // A difference is shared with all who go the same step. A large scene is sent as it is made.
  bool SendDifference(const SceneSnapshot& next) {
    if (pursuit_.base == nullptr && next.static_map_W.blocks().size() > kMostSharedBlocks) {
      return SendWhole(next);
    }
    const auto messages = core_.deltas.Between(pursuit_.base.get(), next, pursuit_.detail);
    return std::ranges::all_of(*messages, [&](const auto& message) { return Send(message); });
  }

  bool SendWhole(const SceneSnapshot& next) {
    v1::FollowSceneResponse message = AboutVersion(next, core_.instance);
    Work work(core_, &context_);
    return WriteDifference(SceneDifference(nullptr, next, pursuit_.detail),
                           [&](const v1::SceneDeltaPart& part) {
                             *message.mutable_delta() = part;
                             work.Rest();
                             return Send(message) && !work.MustEnd();
                           });
  }

  ServerCore& core_;
  Pursuit pursuit_;
  grpc::ServerContext& context_;
  grpc::ServerWriter<v1::FollowSceneResponse>& writer_;
  const Gone gone_;
};

}  // namespace

grpc::Status FollowHandlers::FollowScene(grpc::ServerContext* context,
                                         const v1::FollowSceneRequest* request,
                                         grpc::ServerWriter<v1::FollowSceneResponse>* writer) {
  return Handle(core_, context, "FollowScene", *request, [&](const Peer& peer) -> absl::Status {
    const Quota::Slot slot(core_.follow_streams, peer.name);
    if (!slot.status().ok()) return slot.status();
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
    return Follower(core_, std::move(pursuit), *context, *writer).Run();
  });
}

}  // namespace clearway
