// Calls that may hang, crash or use up all memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"

namespace clearway {

struct CallLimits {
  Duration max_time = std::chrono::seconds(60);    // by the wall clock; above 0
  std::uint64_t max_memory_bytes = 1'000'000'000;  // that the call allocates
  std::uint64_t max_result_bytes = 1'000'000'000;  // that it returns
};

// Calls `function` in a child process, a fork of this one, and returns what it returns. The child
// is gone when this returns, whatever it did, and this process has lost nothing by it. It is a copy
// of the calling thread alone, without signal handlers, descriptors and output. So `function` must
// not take a lock that another thread may hold (that of the allocator excepted) and must not start
// threads. `name` begins messages.
//
// The errors of `function`; DEADLINE_EXCEEDED ("assimp took more than 60 s"); RESOURCE_EXHAUSTED
// for too much memory or too large a result; ABORTED if it crashed ("assimp crashed (signal 6)") or
// threw; UNAVAILABLE if no process can be started. Any thread.
absl::StatusOr<std::string> CallGuarded(
    const std::string& name, const CallLimits& limits,
    const std::function<absl::StatusOr<std::string>()>& function);

// Whether max_memory_bytes is enforced. It is not under sanitizers, which reserve terabytes.
bool GuardsMemory();

}  // namespace clearway
