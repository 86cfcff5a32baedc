// When to open a broken stream again.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <random>
#include <string>

#include "clearway/client/stream_state.h"

namespace clearway {

// Keeps the state of one stream and its pauses. The stream's thread calls Connected and Lost; any
// thread may call state.
class Reconnector {
 public:
  explicit Reconnector(ReconnectOptions options);

  // The server has answered; `instance` tells its starts apart, if it is known. Repeated calls
  // change nothing.
  void Connected(const std::string& instance = "");
  // Whether the stream may be opened again after it ended so: the server is away, or it has no room
  // for a stream that it answered before. A connection that was lost may still hold its place, for
  // the server can take longer than the client to find that out.
  bool MayReturn(const absl::Status& error) const;
  // The stream is broken, or opening it failed. Returns how long to wait before the next attempt;
  // nothing when it is time to give up.
  std::optional<Duration> Lost(const absl::Status& error);

  // The error, of one who gave up.
  absl::Status GivenUp(const absl::Status& error) const;

  StreamState state() const;

 private:
  using Clock = std::chrono::steady_clock;
  Duration NextPause();
  void Report(const StreamState& state) const;

  const ReconnectOptions options_;
  std::minstd_rand random_{std::random_device()()};
  Duration pause_;                     // before the next attempt
  Clock::time_point connected_since_;  // while connected
  std::optional<Clock::time_point> lost_since_;
  bool answered_ = false;  // the stream was connected once

  mutable std::mutex mutex_;
  StreamState state_;
  std::string instance_;  // that answered last
};

}  // namespace clearway
