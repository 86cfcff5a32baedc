#include "server/work.h"

#include <time.h>

#include <memory>

namespace clearway {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(1);   // between two questions whether to go on
constexpr std::chrono::milliseconds kShort(1);  // that a call may compute before it takes turns

std::chrono::nanoseconds ThreadTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

Gone GoneOf(const ServerCore& core, const grpc::ServerContext* context) {
  return [&core, context, gone = false, next_look = Clock::now() + kLook]() mutable {
    const Clock::time_point now = Clock::now();
    if (!gone && now >= next_look) {
      gone = core.cancelling || context->IsCancelled();
      next_look = now + kLook;
    }
    return gone;
  };
}

Work::Work(ServerCore& core, const grpc::ServerContext* context)
    : core_(core),
      context_(context),
      gone_(GoneOf(core, context)),
      began_(ThreadTime()),
      next_look_(Clock::now() + kLook) {}

bool Work::MustEnd() {
  const Clock::time_point now = Clock::now();
  if (must_end_ || now < next_look_) return must_end_;
  next_look_ = now + kLook;
  if (!turn_ && ThreadTime() - began_ >= kShort)
    turn_.emplace(core_.computing, core_.access.NameOf(*context_));
  must_end_ = gone_() || (turn_ && !turn_->Take(gone_));
  return must_end_;
}

void Work::Rest() {
  if (turn_) turn_->Rest();
}

Gone WorkOf(ServerCore& core, const grpc::ServerContext* context) {
  return [work = std::make_shared<Work>(core, context)] { return work->MustEnd(); };
}

}  // namespace clearway
