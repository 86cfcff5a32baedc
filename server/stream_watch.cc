#include "server/stream_watch.h"

#include <grpc/grpc.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "spdlog/spdlog.h"

namespace clearway {

StreamWatch::StreamWatch(Duration for_reader, Duration for_writer)
    : for_reader_{for_reader, absl::StrCat("the client read nothing for ", ToSeconds(for_reader),
                                           " s: the stream has ended")},
      for_writer_{for_writer, absl::StrCat("the client wrote nothing for ", ToSeconds(for_writer),
                                           " s: the stream has ended")},
      thread_([this] { Run(); }) {}

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
}

StreamWatch::Turn::~Turn() {
  std::lock_guard lock(watch_.mutex_);
  turns_.erase(place_);
}

// The status goes out beside the bytes that are not read: TryCancel would send CANCELLED alone.
void StreamWatch::EndOld(const std::list<Turn*>& turns, const Patience& patience) {
  const auto latest = std::chrono::steady_clock::now() - patience.duration;
  for (Turn* turn : turns) {
    if (turn->began_ > latest) break;
    if (std::exchange(turn->ended_, true)) continue;
    spdlog::warn("{}: {}", turn->context_.peer(), patience.message);
    grpc_call_cancel_with_status(turn->context_.c_call(), GRPC_STATUS_UNAVAILABLE,
                                 patience.message.c_str(), nullptr);
  }
}

void StreamWatch::Run() {
  const Duration shorter = std::min(for_reader_.duration, for_writer_.duration);
  std::unique_lock lock(mutex_);
  while (!stop_) {
    changed_.wait_for(lock, std::clamp<Duration>(shorter / 4, std::chrono::milliseconds(10),
                                                 std::chrono::seconds(1)));
    EndOld(writing_, for_reader_);
    EndOld(reading_, for_writer_);
  }
}

}  // namespace clearway
