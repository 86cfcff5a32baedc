// Cancellation and fair scheduling of a call that computes.
#pragma once

#include <grpcpp/server_context.h>

#include <chrono>
#include <optional>

#include "server/core.h"

namespace clearway {

// True once the client has gone, its deadline has passed, or the server ends. For one thread, and
// no longer than both live. Cheap enough to be called in inner loops: gRPC, whose answer takes
// system calls and may wait for another thread's, is asked once a millisecond, and not at all by
// shorter calls.
Gone GoneOf(const ServerCore& core, const grpc::ServerContext* context);

// A call that computes. Once it has computed for a millisecond it takes turns with others
// (ServerCore::computing), and keeps its turn until it rests or ends. One thread.
class Work {
 public:
  Work(ServerCore& core, const grpc::ServerContext* context);

  // To be asked often. Waits for the call's turn; true once nobody waits for its answer any more.
  bool MustEnd();
  // Before it waits for anything else.
  void Rest();

 private:
  ServerCore& core_;
  const grpc::ServerContext* const context_;
  const Gone gone_;
  const std::chrono::nanoseconds began_;
  std::chrono::steady_clock::time_point next_look_;
  bool must_end_ = false;
  std::optional<FairQueue::Call> turn_;  // once it is not short any more
};

// MustEnd of a Work of its own, for calls that wait for nothing else.
Gone WorkOf(ServerCore& core, const grpc::ServerContext* context);

}  // namespace clearway
