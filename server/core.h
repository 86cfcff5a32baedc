// What all services share.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/v1/scene.pb.h"
#include "server/access.h"
#include "server/config.h"
#include "server/delta_cache.h"
#include "server/fair_queue.h"
#include "server/ingestor.h"
#include "server/leases.h"
#include "server/memory_budget.h"
#include "server/open_calls.h"
#include "server/quota.h"
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
  MemoryBudget memory;
  RequestMemory request_memory;
  Versions versions;
  DeltaCache deltas;
  StreamWatch streams;
  FairQueue computing;
  Leases leases;
  Robots robots;
  Ingestor ingestor;

  std::atomic<bool> draining = false;
  std::atomic<bool> cancelling = false;  // and what computes still shall stop

  AccessControl access;
  std::function<void(bool)> on_room;  // set before the first call; see OpenCalls
  OpenCalls open_calls;
  Quota follow_streams, push_streams, watch_streams, plans;
};

}  // namespace clearway
