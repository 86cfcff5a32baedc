// The rhythm in which frames are sent.
#pragma once

#include <chrono>
#include <optional>
#include <thread>

#include "clearway/base/time.h"

namespace clearway::cli {

// Sleeps so that frames leave in the rhythm of their stamps, `rate` times as fast.
class Pace {
 public:
  explicit Pace(std::optional<double> rate) : rate_(rate) {}

  void WaitFor(Time stamp) {
    if (!rate_) return;
    if (!started_) first_ = stamp;
    started_ = true;
    std::this_thread::sleep_until(
        start_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                     std::chrono::duration<double>(ToSeconds(stamp - first_) / *rate_)));
  }

 private:
  const std::optional<double> rate_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool started_ = false;
  Time first_;  // the first frame's
};

}  // namespace clearway::cli
