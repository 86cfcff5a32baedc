// What the server writes to its log.
#pragma once

#include <chrono>
#include <cstdint>

namespace clearway {

// Lets so many lines through in each second, and counts the others: no client can fill a disk, or
// stop a server whose log is read slowly, with what it makes the server say. One thread at a time.
class LineBudget {
 public:
  using Clock = std::chrono::steady_clock;
  explicit LineBudget(std::uint64_t lines_per_second) : lines_per_second_(lines_per_second) {}

  struct Verdict {
    bool write = false;
    std::uint64_t left_out = 0;  // in the seconds before; not 0: say so first
  };
  Verdict Take(Clock::time_point now);

 private:
  const std::uint64_t lines_per_second_;
  Clock::time_point second_begins_;
  std::uint64_t lines_ = 0, left_out_ = 0;
};

// Sends spdlog's lines, OMPL's and gRPC's to stderr, within a LineBudget. Once, before threads are
// started.
void StartLog();

}  // namespace clearway
