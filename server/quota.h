// How much of something clients may have at once.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

#include "absl/status/status.h"

namespace clearway {

// So many of a kind at once, and of those a share at most for one peer (server/access), so that
// none can keep the others out. Any thread may call any method.
class Quota {
 public:
  // `what` names the kind in messages: "push streams".
  Quota(std::string what, std::uint64_t limit, double peer_share);

  // One of them, for as long as it lives. One thread.
  class Slot {
   public:
    Slot(Quota& quota, const std::string& peer);
    ~Slot();
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;

    // RESOURCE_EXHAUSTED naming what there is too much of.
    const absl::Status& status() const { return status_; }

   private:
    Quota& quota_;
    const std::string peer_;
    const absl::Status status_;
  };

  std::uint64_t size() const;
  // Of what one peer may have.
  std::uint64_t peer_limit() const { return peer_limit_; }

 private:
  absl::Status Take(const std::string& peer);
  void GiveBack(const std::string& peer);

  const std::string what_;
  const std::uint64_t limit_;
  const std::uint64_t peer_limit_;
  mutable std::mutex mutex_;
  std::uint64_t size_ = 0;
  std::unordered_map<std::string, std::uint64_t> of_peers_;  // those that have any
};

// What one peer may have of `limit`: the share, at least one.
std::uint64_t PeerLimit(std::uint64_t limit, double peer_share);

// RESOURCE_EXHAUSTED: as many as allowed exist, in all or of one client.
absl::Status TooMany(const std::string& what, std::uint64_t limit);
absl::Status TooManyOfPeer(const std::string& what, std::uint64_t limit);

}  // namespace clearway
