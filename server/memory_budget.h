// How much memory the process may use.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "absl/status/status.h"

namespace clearway {

// Half of the machine's memory, or of what this process's control group may have, if that is less.
std::uint64_t DefaultMemoryLimit();

// limits.max_memory_bytes against what the process uses: maps, versions that are kept or leased,
// requests, answers. Any thread may call it.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t limit_bytes) : limit_bytes_(limit_bytes) {}

  // RESOURCE_EXHAUSTED (NO_MEMORY) if it would be exceeded with so much more. To be asked before
  // anything that grows; it takes microseconds.
  absl::Status Room(std::uint64_t more_bytes = 0) const;

 private:
  const std::uint64_t limit_bytes_;
};

// limits.max_request_memory_bytes: what requests that are being answered, and replies that are not
// read yet, take together. Any thread may call it; it must outlive the shares.
class RequestMemory {
 public:
  explicit RequestMemory(std::uint64_t limit_bytes) : limit_bytes_(limit_bytes) {}

  // A message's part, for as long as it lives; or why there is none.
  class Share {
   public:
    Share() = default;
    explicit Share(absl::Status refused) : status_(std::move(refused)) {}
    Share(RequestMemory& memory, std::uint64_t bytes) : memory_(&memory), bytes_(bytes) {}
    Share(Share&& other) noexcept;
    Share& operator=(Share&& other) noexcept;
    ~Share();

    const absl::Status& status() const { return status_; }

   private:
    RequestMemory* memory_ = nullptr;
    std::uint64_t bytes_ = 0;
    absl::Status status_;
  };
  // RESOURCE_EXHAUSTED (NO_MEMORY) in its status if others take too much.
  Share Take(std::uint64_t bytes);

 private:
  const std::uint64_t limit_bytes_;
  std::atomic<std::uint64_t> taken_bytes_ = 0;
};

}  // namespace clearway
