// Versions that clients hold while they plan on them.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_snapshot.h"
#include "clearway/wire/answers.h"

namespace clearway {

// Leases with a time to live of this computer's clock. Any thread may call any method.
class Leases {
 public:
  using Clock = std::chrono::steady_clock;
  struct Options {
    std::size_t max_leases = 256;
    std::size_t max_of_peer = 256;
    Duration max_ttl = std::chrono::minutes(10);
    std::function<Clock::time_point()> now = Clock::now;
  };
  explicit Leases(Options options) : options_(std::move(options)) {}

  // RESOURCE_EXHAUSTED when as many as allowed are held, in all or by the peer. Times to live are
  // cut to the longest.
  absl::StatusOr<LeaseGrant> Acquire(ScenePtr scene, Duration ttl, const std::string& peer);
  // FAILED_PRECONDITION once the lease is gone.
  absl::StatusOr<LeaseGrant> Renew(const std::string& id, Duration ttl);
  absl::StatusOr<ScenePtr> Find(const std::string& id);
  void Release(const std::string& id);
  std::size_t size();

 private:
  struct Lease {
    ScenePtr scene;
    Clock::time_point end;
    std::string peer;  // that holds it
  };
  using LeaseMap = std::map<std::string, Lease>;
  // Takes the leases that have ended out of the map, with the lock held. The caller frees them
  // after the lock: one may be the last owner of a whole scene.
  [[nodiscard]] LeaseMap TakeEnded();

  const Options options_;
  std::mutex mutex_;
  LeaseMap leases_;
};

}  // namespace clearway
