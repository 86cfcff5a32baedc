// The calls that run, and who makes them.
#pragma once

#include <grpcpp/server_context.h>

#include <functional>
#include <list>
#include <mutex>
#include <string>

#include "server/access.h"
#include "server/quota.h"

namespace clearway {

// gRPC alone would end calls with CANCELLED or UNAVAILABLE, as it happens, when a server ends, and
// cannot end those of one client. Any thread may call any method.
class OpenCalls {
 public:
  // `on_room` is told whether another call would be let in, each time that changes; it is called
  // with the lock held.
  OpenCalls(std::uint64_t limit, double peer_share, std::function<void(bool)> on_room);

  // One call for as long as it lives, which is no longer than its context. One thread.
  class Call {
   public:
    Call(OpenCalls& calls, grpc::ServerContext& context, Peer peer, std::string method);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    // RESOURCE_EXHAUSTED if there are too many.
    const absl::Status& status() const { return slot_.status(); }
    const Peer& peer() const { return peer_; }

   private:
    friend class OpenCalls;
    void End(const absl::Status& status);

    OpenCalls& calls_;
    grpc::ServerContext& context_;
    const Peer peer_;
    const std::string method_;
    const Quota::Slot slot_;
    std::list<Call*>::iterator place_;
  };

  // Ends all calls, now and from now on: their clients get the status, their handlers find
  // themselves cancelled.
  void EndAll(const absl::Status& status);
  // Ends those for which why(caller, peer, method) is not OK, with that status.
  void EndIf(
      const std::function<absl::Status(const Caller&, const Peer&, const std::string&)>& why);

  std::uint64_t size() const { return quota_.size(); }

 private:
  void TellRoom();  // with the lock held

  Quota quota_;
  const std::uint64_t limit_;
  const std::function<void(bool)> on_room_;
  std::mutex mutex_;
  std::list<Call*> calls_;
  bool room_ = true;
  absl::Status all_end_;  // OK until they do
};

}  // namespace clearway
