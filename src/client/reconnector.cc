#include "client/reconnector.h"

#include <algorithm>

namespace clearway {

Reconnector::Reconnector(ReconnectOptions options)
    : options_(std::move(options)), pause_(options_.first_pause) {}

void Reconnector::Connected(const std::string& instance) {
  StreamState state;
  {
    std::lock_guard lock(mutex_);
    if (state_.connected) return;
    state_.connected = true;
    if (!state_.last_error.ok()) ++state_.reconnects;
    if (!instance.empty()) {
      if (!instance_.empty() && instance != instance_) ++state_.server_restarts;
      instance_ = instance;
    }
    state = state_;
  }
  connected_since_ = Clock::now();
  lost_since_.reset();
  Report(state);
}

std::optional<Duration> Reconnector::Lost(const absl::Status& error) {
  const Clock::time_point now = Clock::now();
  StreamState state;
  bool was_connected = false;
  {
    std::lock_guard lock(mutex_);
    was_connected = state_.connected;
    state_.connected = false;
    state_.last_error = error;
    state = state_;
  }
  // A stream that breaks as soon as it is open is no better than one that cannot be opened.
  if (was_connected && now - connected_since_ >= options_.max_pause) pause_ = options_.first_pause;
  if (!lost_since_) lost_since_ = now;
  if (was_connected) Report(state);
  const Duration pause = NextPause();
  if (now - *lost_since_ + pause > options_.give_up_after) return std::nullopt;
  return pause;
}

Duration Reconnector::NextPause() {
  const double share = std::uniform_real_distribution<double>(0.75, 1)(random_);
  const Duration pause = FromSeconds(share * ToSeconds(pause_));
  pause_ = std::min(2 * pause_, std::max(options_.first_pause, options_.max_pause));
  return pause;
}

void Reconnector::Report(const StreamState& state) const {
  if (options_.on_change) options_.on_change(state);
}

StreamState Reconnector::state() const {
  std::lock_guard lock(mutex_);
  return state_;
}

}  // namespace clearway
