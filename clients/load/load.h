// Load on a server: callers that ask at once, and how long their answers take.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"

namespace clearway {

// What a load has shown. A plain value.
struct LoadReport {
  double seconds = 0;                // from the first question to the last answer
  std::vector<double> latencies_ms;  // of each call, ascending

  std::size_t calls() const { return latencies_ms.size(); }
  double CallsPerSecond() const;
  // The least latency that this share of the calls, 0 to 1, does not exceed; 0 without calls.
  double LatencyMs(double share) const;
};

// One question and its answer. Each caller's is called by one thread.
using LoadCall = std::function<absl::Status()>;

// Runs each caller on a thread of its own for `duration`: a question, its answer, the next
// question. Each calls once before the clock starts. The first error ends the load and is returned.
absl::StatusOr<LoadReport> RunLoad(const std::vector<LoadCall>& callers, Duration duration);

}  // namespace clearway
