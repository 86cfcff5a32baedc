#include "server/stream_watch.h"

#include <grpc/grpc.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "spdlog/spdlog.h"

namespace clearway {

StreamWatch::StreamWatch(Duration patience) : patience_(patience), thread_([this] { Run(); }) {}

StreamWatch::~StreamWatch() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

StreamWatch::Turn::Turn(StreamWatch& watch, grpc::ServerContext& context, For what)
    : watch_(watch),
      context_(context),
      turns_(what == For::kReading ? watch.reading_ : watch.writing_) {
  std::lock_guard lock(watch_.mutex_);
  place_ = turns_.insert(turns_.end(), this);
  if (!watch_.all_end_.empty()) End(watch_.all_end_);
}

StreamWatch::Turn::~Turn() {
  std::lock_guard lock(watch_.mutex_);
  turns_.erase(place_);
}

// The status goes out beside the bytes that are not read: TryCancel would send CANCELLED alone.
void StreamWatch::Turn::End(const std::string& message) {
  if (std::exchange(ended_, true)) return;
  grpc_call_cancel_with_status(context_.c_call(), GRPC_STATUS_UNAVAILABLE, message.c_str(),
                               nullptr);
}

void StreamWatch::EndAll(const std::string& message) {
  std::lock_guard lock(mutex_);
  all_end_ = message;
  for (Turn* turn : writing_) turn->End(message);
  for (Turn* turn : reading_) turn->End(message);
}

void StreamWatch::Run() {
  const std::string message = absl::StrCat("the client read nothing for ", ToSeconds(patience_),
                                           " s: the stream has ended");
  std::unique_lock lock(mutex_);
  while (!stop_) {
    changed_.wait_for(lock, std::clamp<Duration>(patience_ / 4, std::chrono::milliseconds(10),
                                                 std::chrono::seconds(1)));
    const auto latest = std::chrono::steady_clock::now() - patience_;
    for (Turn* turn : writing_) {
      if (turn->began_ > latest) break;
      if (turn->ended_) continue;
      spdlog::warn("{}: {}", turn->context_.peer(), message);
      turn->End(message);
    }
  }
}

}  // namespace clearway
