// What all services share.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/v1/scene.pb.h"
#include "server/config.h"
#include "server/delta_cache.h"
#include "server/fair_queue.h"
#include "server/ingestor.h"
#include "server/leases.h"
#include "server/robots.h"
#include "server/stream_watch.h"
#include "server/versions.h"

namespace clearway {

FrameLimits FrameLimitsOf(const ServerLimits& limits);

// The server without its transport. Any thread may use it; every member guards itself.
struct ServerCore {
  explicit ServerCore(const ServerConfig& config);

  // The version that a request asks for: FAILED_PRECONDITION for a lease that is gone or a version
  // that did not come in time, CANCELLED once `gone`.
  absl::StatusOr<ScenePtr> SceneFor(const v1::SceneSelector& selector, const Gone& gone);

  const ServerConfig config;
  const std::string instance;  // differs for each start
  const std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  Versions versions;
  DeltaCache deltas;
  StreamWatch streams;
  FairQueue computing;
  Leases leases;
  Robots robots;
  Ingestor ingestor;

  std::atomic<bool> draining = false;
  std::atomic<bool> cancelling = false;  // and what computes still shall stop
  std::atomic<std::uint64_t> calls = 0, follow_streams = 0, push_streams = 0;
  std::atomic<std::uint64_t> plans = 0, watch_streams = 0;
};

// Counts someone in for as long as it lives, unless there are too many already. One thread.
class Slot {
 public:
  Slot(std::atomic<std::uint64_t>& count, std::uint64_t limit)
      : count_(count), ok_(count.fetch_add(1) < limit) {}
  ~Slot() { count_.fetch_sub(1); }
  Slot(const Slot&) = delete;
  Slot& operator=(const Slot&) = delete;
  bool ok() const { return ok_; }

 private:
  std::atomic<std::uint64_t>& count_;
  const bool ok_;
};
// RESOURCE_EXHAUSTED naming `what`.
absl::Status TooMany(const std::string& what, std::uint64_t limit);

}  // namespace clearway
