// The calls that run, and who makes them.
#pragma once

#include <grpcpp/server_context.h>

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "server/access.h"
#include "server/memory_budget.h"
#include "server/quota.h"

namespace clearway {

// gRPC alone would end calls with CANCELLED or UNAVAILABLE, as it happens, when a server ends, and
// cannot end those of one client. Any thread may call any method.
class OpenCalls {
  // By one call.
  struct Taken {
    std::unique_ptr<const Quota::Slot> slot;
    RequestMemory::Share reply;
  };

 public:
  // `on_room` is told whether another call would be let in, each time that changes; it is called
  // with the lock held.
  OpenCalls(std::uint64_t limit, double peer_share, std::function<void(bool)> on_room);

  // From now on Ended tells when a call has ended, and it counts as open until then: a reply that
  // its client does not read takes memory and a thread. Before the first call.
  void ExpectEnds() { ends_are_told_ = true; }
  // Nothing that this class knows refers to the context any more.
  void Ended(const grpc::ServerContextBase* context);

  // One call's handler for as long as it lives, which is no longer than its context. One thread.
  class Call {
   public:
    Call(OpenCalls& calls, grpc::ServerContext& context, Peer peer, std::string method);
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    // RESOURCE_EXHAUSTED if there are too many.
    const absl::Status& status() const { return what_it_takes_.slot->status(); }
    const Peer& peer() const { return peer_; }
    // What its reply takes, until the call has ended.
    void Keep(RequestMemory::Share reply) { what_it_takes_.reply = std::move(reply); }

   private:
    friend class OpenCalls;
    void Cancel(const absl::Status& status);

    OpenCalls& calls_;
    grpc::ServerContext& context_;
    const Peer peer_;
    const std::string method_;
    Taken what_it_takes_;
    std::list<Call*>::iterator place_;
  };

  // Ends all calls, now and from now on: their clients get the status, their handlers find
  // themselves cancelled.
  void EndAll(const absl::Status& status);
  // Ends those for which why(caller, peer, method) is not OK, with that status.
  void EndIf(
      const std::function<absl::Status(const Caller&, const Peer&, const std::string&)>& why);

  // Those whose clients wait for a reply or do not read it.
  std::uint64_t size() const { return quota_.size(); }
  std::uint64_t running() const;  // of those, the ones whose handlers have not returned

 private:
  void TellRoom();  // with the lock held

  Quota quota_;
  const std::uint64_t limit_;
  const std::function<void(bool)> on_room_;
  bool ends_are_told_ = false;
  mutable std::mutex mutex_;
  std::list<Call*> calls_;
  std::unordered_map<const grpc::ServerContextBase*, Taken> unread_;  // their handlers returned
  bool room_ = true;
  absl::Status all_end_;  // OK until they do
};

}  // namespace clearway
