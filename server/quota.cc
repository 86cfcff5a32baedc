#include "server/quota.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "wire/status.h"

namespace clearway {

Quota::Quota(std::string what, std::uint64_t limit, double peer_share)
    : what_(std::move(what)), limit_(limit), peer_limit_(PeerLimit(limit, peer_share)) {}

absl::Status Quota::Take(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  if (size_ >= limit_) return TooMany(what_, limit_);
  std::uint64_t& of_peer = of_peers_[peer];  // there is one already if it has as many as it may
  if (of_peer >= peer_limit_) return TooManyOfPeer(what_, peer_limit_);
  ++of_peer;
  ++size_;
  return absl::OkStatus();
}

void Quota::GiveBack(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  --size_;
  const auto of_peer = of_peers_.find(peer);
  if (--of_peer->second == 0) of_peers_.erase(of_peer);
}

std::uint64_t Quota::size() const {
  const std::lock_guard lock(mutex_);
  return size_;
}

Quota::Slot::Slot(Quota& quota, const std::string& peer)
    : quota_(quota), peer_(peer), status_(quota.Take(peer)) {}

Quota::Slot::~Slot() {
  if (status_.ok()) quota_.GiveBack(peer_);
}

std::uint64_t PeerLimit(std::uint64_t limit, double peer_share) {
  const double share = std::ceil(static_cast<double>(limit) * peer_share);
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(share), 1, limit);
}

absl::Status TooMany(const std::string& what, std::uint64_t limit) {
  return WithReason(absl::ResourceExhaustedError(
                        absl::StrCat("too many ", what, " at once; the limit is ", limit)),
                    "TOO_MANY");
}

absl::Status TooManyOfPeer(const std::string& what, std::uint64_t limit) {
  return WithReason(absl::ResourceExhaustedError(absl::StrCat(
                        "too many ", what, " of this client at once; the limit for one is ", limit,
                        " (limits.max_peer_share)")),
                    "TOO_MANY_OF_CLIENT");
}

}  // namespace clearway
