#include "server/stall_watch.h"

#include <grpc/grpc.h>

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "spdlog/spdlog.h"

namespace clearway {

StallWatch::StallWatch(Duration patience) : patience_(patience), thread_([this] { Run(); }) {}

StallWatch::~StallWatch() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

StallWatch::Turn::Turn(StallWatch& watch, grpc::ServerContext& context)
    : watch_(watch), context_(context) {
  std::lock_guard lock(watch_.mutex_);
  place_ = watch_.turns_.insert(watch_.turns_.end(), this);
}

StallWatch::Turn::~Turn() {
  std::lock_guard lock(watch_.mutex_);
  watch_.turns_.erase(place_);
}

// The status goes out beside the bytes that are not read: TryCancel would send CANCELLED alone.
void StallWatch::Run() {
  const std::string message = absl::StrCat("the client read nothing for ", ToSeconds(patience_),
                                           " s: the stream has ended");
  std::unique_lock lock(mutex_);
  while (!stop_) {
    changed_.wait_for(lock, std::clamp<Duration>(patience_ / 4, std::chrono::milliseconds(10),
                                                 std::chrono::seconds(1)));
    const auto latest = std::chrono::steady_clock::now() - patience_;
    for (Turn* turn : turns_) {
      if (turn->began_ > latest) break;
      if (std::exchange(turn->ended_, true)) continue;
      spdlog::warn("{}: {}", turn->context_.peer(), message);
      grpc_call_cancel_with_status(turn->context_.c_call(), GRPC_STATUS_UNAVAILABLE,
                                   message.c_str(), nullptr);
    }
  }
}

}  // namespace clearway
