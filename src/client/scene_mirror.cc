#include "clearway/client/scene_mirror.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_delta.h"
#include "client/call.h"
#include "client/reconnector.h"
#include "wire/delta_wire.h"

namespace clearway {

struct SceneMirror::Impl {
  using Clock = std::chrono::steady_clock;

  Impl(std::shared_ptr<Connection> c, const SceneMirrorOptions& o)
      : connection(std::move(c)), options(o), reconnector(NeverGivingUp(o.reconnect)) {}

  static ReconnectOptions NeverGivingUp(ReconnectOptions options) {
    options.give_up_after = Duration::max();
    return options;
  }

  const std::shared_ptr<Connection> connection;
  const SceneMirrorOptions options;
  Reconnector reconnector;

  mutable std::mutex mutex;
  mutable std::condition_variable changed;
  ScenePtr latest;
  Clock::time_point confirmed;  // when `latest` was known to be the server's newest
  bool connected = false;
  SceneMirrorStats stats;
  bool stop = false;
  grpc::ClientContext* context = nullptr;  // of the open stream, to cancel it

  std::string instance;  // the server that `latest` came from; the thread's own
  std::thread thread;

  void Run() {
    bool from_nothing = true;
    while (true) {
      const absl::Status status = FollowOnce(from_nothing);
      // A lost connection keeps what we have; anything else is not to be built upon.
      from_nothing = !reconnector.MayReturn(status);
      {
        std::lock_guard lock(mutex);
        connected = false;
        if (stop) return;
      }
      const std::optional<Duration> pause = reconnector.Lost(status);
      std::unique_lock lock(mutex);
      changed.wait_for(lock, *pause, [&] { return stop; });
      if (stop) return;
    }
  }

  // Follows one stream until it breaks; says why.
  absl::Status FollowOnce(bool from_nothing) {
    grpc::ClientContext stream_context;
    {
      std::lock_guard lock(mutex);
      if (stop) return absl::CancelledError("the mirror is ending");
      context = &stream_context;
    }
    v1::FollowSceneRequest request;
    request.set_min_interval_s(ToSeconds(options.min_interval));
    request.set_states_only(options.states_only);
    request.set_heartbeat_s(ToSeconds(options.heartbeat));
    ScenePtr base = from_nothing ? nullptr : latest;
    if (base != nullptr) {
      request.set_from_version(base->version);
      request.set_server_instance(instance);
    }
    AwaitConnection(*connection->impl().channel, [this] {
      std::lock_guard lock(mutex);
      return stop;
    });
    const auto stream = connection->impl().follow->FollowScene(&stream_context, request);
    absl::Status broken = ReadStream(*stream, std::move(base));
    if (!broken.ok()) stream_context.TryCancel();
    const absl::Status finished = FromGrpc(stream->Finish());
    std::lock_guard lock(mutex);
    context = nullptr;
    return broken.ok() ? finished : broken;
  }

  absl::Status ReadStream(grpc::ClientReader<v1::FollowSceneResponse>& stream, ScenePtr base) {
    DeltaAssembler assembler;
    v1::FollowSceneResponse response;
    while (stream.Read(&response)) {
      if (!response.has_delta()) {
        Confirm(response, base.get());
        continue;
      }
      auto delta = assembler.Add(response.delta());
      if (!delta.ok()) return delta.status();
      if (!delta->has_value()) continue;
      const bool full = (*delta)->from_version == 0;
      auto scene = Apply(full ? nullptr : base.get(), **delta);
      if (!scene.ok()) return scene.status();
      base = std::make_shared<const SceneSnapshot>(*std::move(scene));
      instance = response.server_instance();
      Show(base, full);
    }
    return absl::OkStatus();
  }

  void Show(ScenePtr scene, bool full) {
    {
      std::lock_guard lock(mutex);
      latest.swap(scene);
      ++stats.deltas_applied;
      stats.full_syncs += full;
      confirmed = Clock::now();
      connected = true;
    }
    reconnector.Connected(instance);
    changed.notify_all();
  }

  // A heartbeat.
  void Confirm(const v1::FollowSceneResponse& response, const SceneSnapshot* base) {
    if (base == nullptr || response.scene().version() != base->version) return;
    {
      std::lock_guard lock(mutex);
      confirmed = Clock::now();
      connected = true;
    }
    reconnector.Connected(instance);
    changed.notify_all();
  }

  absl::StatusOr<ScenePtr> Latest(Duration max_age) const {
    std::lock_guard lock(mutex);
    const Duration age = Clock::now() - confirmed;
    if (age <= max_age) return latest;
    const StreamState state = reconnector.state();
    return absl::UnavailableError(
        absl::StrCat("the mirror's scene was last confirmed ", ToSeconds(age),
                     " s ago; the limit is ", ToSeconds(max_age), " s",
                     state.connected || state.last_error.ok()
                         ? ""
                         : absl::StrCat(" (", std::string(state.last_error.message()), ")")));
  }
};

SceneMirror::SceneMirror(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

absl::StatusOr<std::unique_ptr<SceneMirror>> SceneMirror::Follow(
    std::shared_ptr<Connection> connection, const SceneMirrorOptions& options) {
  auto impl = std::make_unique<Impl>(std::move(connection), options);
  impl->thread = std::thread([raw = impl.get()] { raw->Run(); });
  std::unique_ptr<SceneMirror> mirror(new SceneMirror(std::move(impl)));
  auto first = mirror->WaitFor(0, mirror->impl_->connection->options().deadline);
  if (first.ok()) return mirror;
  const absl::Status broken = mirror->state().last_error;
  return broken.ok() ? first.status() : broken;
}

SceneMirror::~SceneMirror() {
  {
    std::lock_guard lock(impl_->mutex);
    impl_->stop = true;
    if (impl_->context != nullptr) impl_->context->TryCancel();
  }
  impl_->changed.notify_all();
  impl_->thread.join();
}

ScenePtr SceneMirror::Latest() const {
  std::lock_guard lock(impl_->mutex);
  return impl_->latest;
}

absl::StatusOr<ScenePtr> SceneMirror::WaitFor(std::uint64_t version, Duration timeout) const {
  std::unique_lock lock(impl_->mutex);
  const auto there = [&] {
    return impl_->connected && impl_->latest != nullptr && impl_->latest->version >= version;
  };
  if (impl_->changed.wait_for(lock, timeout, there)) return impl_->latest;
  return absl::DeadlineExceededError(absl::StrCat("version ", version, " did not come within ",
                                                  ToSeconds(timeout), " s",
                                                  impl_->connected ? "" : "; not connected"));
}

absl::StatusOr<ScenePtr> SceneMirror::Latest(Duration max_age) const {
  return impl_->Latest(max_age);
}

StreamState SceneMirror::state() const { return impl_->reconnector.state(); }

SceneMirrorStats SceneMirror::stats() const {
  std::lock_guard lock(impl_->mutex);
  return impl_->stats;
}

}  // namespace clearway
