#include "server/memory_budget.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "server/memory_use.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

// The file says "max" where there is no limit.
std::uint64_t LimitIn(const std::filesystem::path& file) {
  std::uint64_t bytes = 0;
  std::ifstream stream(file);
  return stream >> bytes ? bytes : kNoLimit;
}

// Of the group and of those around it.
std::uint64_t LimitOfGroup(const std::filesystem::path& root, std::string group, const char* file) {
  std::uint64_t least = LimitIn(root / file);
  for (; group.size() > 1; group.erase(group.rfind('/'))) {
    least = std::min(least, LimitIn(root / group.substr(1) / file));
  }
  return least;
}

// "0::/group" of version 2, "7:memory:/group" of version 1 (man 7 cgroups).
std::uint64_t LimitOfControlGroups() {
  std::uint64_t least = kNoLimit;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::vector<std::string> parts = absl::StrSplit(line, absl::MaxSplits(':', 2));
    if (parts.size() < 3) continue;
    const std::vector<std::string> controllers = absl::StrSplit(parts[1], ',');
    if (parts[1].empty()) {
      least = std::min(least, LimitOfGroup("/sys/fs/cgroup", parts[2], "memory.max"));
    } else if (std::ranges::count(controllers, "memory") > 0) {
      least =
          std::min(least, LimitOfGroup("/sys/fs/cgroup/memory", parts[2], "memory.limit_in_bytes"));
    }
  }
  return least;
}

}  // namespace

std::uint64_t DefaultMemoryLimit() {
  const auto machine = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min(machine, LimitOfControlGroups()) / 2;
}

absl::Status MemoryBudget::Room(std::uint64_t more_bytes) const {
  const std::uint64_t used_bytes = CurrentMemoryUse().heap_bytes_in_use;
  if (used_bytes <= limit_bytes_ && more_bytes <= limit_bytes_ - used_bytes) {
    return absl::OkStatus();
  }
  const std::string wanted =
      more_bytes > 0 ? absl::StrCat(" and would need ", more_bytes, " more") : "";
  return WithReason(absl::ResourceExhaustedError(
                        absl::StrCat("the server uses ", used_bytes, " bytes of memory", wanted,
                                     "; limits.max_memory_bytes is ", limit_bytes_)),
                    "NO_MEMORY");
}

RequestMemory::Share::Share(Share&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)),
      bytes_(other.bytes_),
      status_(std::move(other.status_)) {}

RequestMemory::Share& RequestMemory::Share::operator=(Share&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  std::swap(status_, other.status_);
  return *this;
}

RequestMemory::Share::~Share() {
  if (memory_ != nullptr) memory_->taken_bytes_ -= bytes_;
}

RequestMemory::Share RequestMemory::Take(std::uint64_t bytes) {
  const std::uint64_t before = taken_bytes_.fetch_add(bytes);
  if (before <= limit_bytes_ && bytes <= limit_bytes_ - before) return Share(*this, bytes);
  taken_bytes_ -= bytes;
  return Share(WithReason(absl::ResourceExhaustedError(absl::StrCat(
                              "requests and replies take ", before, " bytes, and this one ", bytes,
                              " more; limits.max_request_memory_bytes is ", limit_bytes_)),
                          "NO_MEMORY"));
}

}  // namespace clearway
