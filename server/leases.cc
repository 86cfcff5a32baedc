#include "server/leases.h"

#include <algorithm>
#include <random>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "server/quota.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Not to be guessed: a lease is whoever's knows its id.
std::string NewId() {
  std::random_device random;
  return absl::StrFormat("%08x%08x%08x%08x", random(), random(), random(), random());
}

absl::Status GoneError(const std::string& id) {
  return WithReason(absl::FailedPreconditionError(absl::StrCat("lease_id: lease ", id.substr(0, 64),
                                                               " has ended or never was")),
                    "LEASE_GONE");
}

}  // namespace

Leases::LeaseMap Leases::TakeEnded() {
  const Clock::time_point now = options_.now();
  LeaseMap ended;
  for (auto lease = leases_.begin(); lease != leases_.end();) {
    const auto next = std::next(lease);
    if (lease->second.end <= now) ended.insert(leases_.extract(lease));
    lease = next;
  }
  return ended;
}

absl::StatusOr<LeaseGrant> Leases::Acquire(ScenePtr scene, Duration ttl, const std::string& peer) {
  const Duration granted = std::min(ttl, options_.max_ttl);
  LeaseMap ended;  // freed after the lock
  std::lock_guard lock(mutex_);
  ended = TakeEnded();
  if (leases_.size() >= options_.max_leases) {
    return WithReason(absl::ResourceExhaustedError(
                          absl::StrCat("as many leases as allowed are held: ", leases_.size())),
                      "TOO_MANY_LEASES");
  }
  const auto of_peer =
      std::ranges::count_if(leases_, [&](const auto& entry) { return entry.second.peer == peer; });
  if (static_cast<std::size_t>(of_peer) >= options_.max_of_peer) {
    return TooManyOfPeer("leases", options_.max_of_peer);
  }
  const std::string id = NewId();
  LeaseGrant grant{{scene->version, scene->stamp}, id, granted};
  leases_[id] = {std::move(scene), options_.now() + granted, peer};
  return grant;
}

absl::StatusOr<LeaseGrant> Leases::Renew(const std::string& id, Duration ttl) {
  const Duration granted = std::min(ttl, options_.max_ttl);
  LeaseMap ended;  // freed after the lock
  std::lock_guard lock(mutex_);
  ended = TakeEnded();
  const auto lease = leases_.find(id);
  if (lease == leases_.end()) return GoneError(id);
  lease->second.end = options_.now() + granted;
  return LeaseGrant{{lease->second.scene->version, lease->second.scene->stamp}, id, granted};
}

absl::StatusOr<ScenePtr> Leases::Find(const std::string& id) {
  LeaseMap ended;  // freed after the lock
  std::lock_guard lock(mutex_);
  ended = TakeEnded();
  const auto lease = leases_.find(id);
  if (lease == leases_.end()) return GoneError(id);
  return lease->second.scene;
}

void Leases::Release(const std::string& id) {
  LeaseMap::node_type released;  // freed after the lock
  std::lock_guard lock(mutex_);
  released = leases_.extract(id);
}

std::size_t Leases::size() {
  LeaseMap ended;  // freed after the lock
  std::lock_guard lock(mutex_);
  ended = TakeEnded();
  return leases_.size();
}

}  // namespace clearway
