#include "load/load.h"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

namespace clearway {
namespace {

using Clock = std::chrono::steady_clock;

// What the callers of one load share. Any thread.
class Load {
 public:
  Load(std::ptrdiff_t callers, Duration duration) : start_(callers), duration_(duration) {}

  void Run(const LoadCall& caller) {
    Note(caller(), {});
    start_.arrive_and_wait();
    std::vector<double> latencies_ms;
    const Clock::time_point begin = Clock::now();
    Clock::time_point now = begin;
    absl::Status status;
    while (status.ok() && !failed_ && now - begin < duration_) {
      status = caller();
      const Clock::time_point end = Clock::now();
      latencies_ms.push_back(std::chrono::duration<double, std::milli>(end - now).count());
      now = end;
    }
    Note(status, latencies_ms, std::chrono::duration<double>(now - begin).count());
  }

  absl::StatusOr<LoadReport> Report() && {
    if (!status_.ok()) return status_;
    std::sort(report_.latencies_ms.begin(), report_.latencies_ms.end());
    return std::move(report_);
  }

 private:
  void Note(const absl::Status& status, const std::vector<double>& latencies_ms,
            double seconds = 0) {
    const std::lock_guard lock(mutex_);
    status_.Update(status);
    failed_ = !status_.ok();
    report_.latencies_ms.insert(report_.latencies_ms.end(), latencies_ms.begin(),
                                latencies_ms.end());
    report_.seconds = std::max(report_.seconds, seconds);
  }

  std::barrier<> start_;
  const Duration duration_;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  absl::Status status_;  // the first error
  LoadReport report_;
};

}  // namespace

double LoadReport::CallsPerSecond() const {
  return seconds > 0 ? static_cast<double>(calls()) / seconds : 0;
}

double LoadReport::LatencyMs(double share) const {
  if (latencies_ms.empty()) return 0;
  const double rank = std::ceil(share * static_cast<double>(calls()));
  return latencies_ms[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

absl::StatusOr<LoadReport> RunLoad(const std::vector<LoadCall>& callers, Duration duration) {
  Load load(std::ssize(callers), duration);
  std::vector<std::thread> threads;
  for (const LoadCall& caller : callers) threads.emplace_back([&] { load.Run(caller); });
  for (std::thread& thread : threads) thread.join();
  return std::move(load).Report();
}

}  // namespace clearway
