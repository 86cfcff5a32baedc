#include "client/reconnector.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "wire/status.h"

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
  answered_ = true;
  connected_since_ = Clock::now();
  lost_since_.reset();
  Report(state);
}

bool Reconnector::MayReturn(const absl::Status& error) const {
  return absl::IsUnavailable(error) || (answered_ && ReasonOf(error) == "TOO_MANY");
}

absl::Status Reconnector::GivenUp(const absl::Status& error) const {
  absl::Status given_up(error.code(),
                        absl::StrCat(std::string(error.message()), "; gave up after ",
                                     ToSeconds(options_.give_up_after), " s without the stream"));
  error.ForEachPayload(
      [&](auto url, const absl::Cord& payload) { given_up.SetPayload(url, payload); });
  return given_up;
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
  const Duration pause = std::max(NextPause(), RetryDelayOf(error).value_or(Duration::zero()));
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
