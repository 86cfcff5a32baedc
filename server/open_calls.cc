#include "server/open_calls.h"

#include <grpc/grpc.h>

#include <utility>

namespace clearway {

OpenCalls::OpenCalls(std::uint64_t limit, double peer_share, std::function<void(bool)> on_room)
    : quota_("calls", limit, peer_share), limit_(limit), on_room_(std::move(on_room)) {}

OpenCalls::Call::Call(OpenCalls& calls, grpc::ServerContext& context, Peer peer, std::string method)
    : calls_(calls),
      context_(context),
      peer_(std::move(peer)),
      method_(std::move(method)),
      what_it_takes_{std::make_unique<const Quota::Slot>(calls.quota_, peer_.name), {}} {
  const std::lock_guard lock(calls_.mutex_);
  place_ = calls_.calls_.insert(calls_.calls_.end(), this);
  calls_.TellRoom();
  if (!calls_.all_end_.ok()) Cancel(calls_.all_end_);
}

OpenCalls::Call::~Call() {
  const std::lock_guard lock(calls_.mutex_);
  calls_.calls_.erase(place_);
  if (calls_.ends_are_told_ && status().ok()) {
    calls_.unread_.emplace(&context_, std::move(what_it_takes_));
    return;
  }
  what_it_takes_ = {};
  calls_.TellRoom();
}

void OpenCalls::Ended(const grpc::ServerContextBase* context) {
  const std::lock_guard lock(mutex_);
  if (unread_.erase(context) > 0) TellRoom();
}

std::uint64_t OpenCalls::running() const {
  const std::lock_guard lock(mutex_);
  return calls_.size();
}

void OpenCalls::Call::Cancel(const absl::Status& status) {
  grpc_call_cancel_with_status(context_.c_call(), static_cast<grpc_status_code>(status.code()),
                               std::string(status.message()).c_str(), nullptr);
}

void OpenCalls::TellRoom() {
  const bool room = quota_.size() < limit_;
  if (std::exchange(room_, room) != room) on_room_(room);
}

void OpenCalls::EndAll(const absl::Status& status) {
  const std::lock_guard lock(mutex_);
  all_end_ = status;
  for (Call* call : calls_) call->Cancel(status);
}

void OpenCalls::EndIf(
    const std::function<absl::Status(const Caller&, const Peer&, const std::string&)>& why) {
  const std::lock_guard lock(mutex_);
  for (Call* call : calls_) {
    const absl::Status status = why(CallerOf(call->context_), call->peer_, call->method_);
    if (!status.ok()) call->Cancel(status);
  }
}

}  // namespace clearway
