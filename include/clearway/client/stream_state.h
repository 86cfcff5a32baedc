// How long-lived streams (mirrors, frame senders, watches) survive a lost connection.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "absl/status/status.h"
#include "clearway/base/time.h"

namespace clearway {

// A plain value.
struct StreamState {
  bool connected = false;        // the server has answered on the stream that is open now
  std::uint64_t reconnects = 0;  // times the server answered again after a loss
  // Reconnections after which the server had restarted: its scene from before is lost. Counted by
  // senders and mirrors.
  std::uint64_t server_restarts = 0;
  absl::Status last_error;  // why the stream broke last; OK if it never did
};

// A plain value.
struct ReconnectOptions {
  // A broken stream is opened again after a pause. The pause doubles with each failed attempt, up
  // to the longest; each is cut by up to a quarter at random, so that the clients of one server do
  // not return all at once.
  Duration first_pause = std::chrono::milliseconds(100);
  Duration max_pause = std::chrono::seconds(5);
  // The stream ends with its last error when it has been broken for longer than this.
  Duration give_up_after = Duration::max();
  // Called whenever the stream breaks or is connected again, from a thread of the stream's own. It
  // must not call the object that owns the stream.
  std::function<void(const StreamState&)> on_change = {};
};

}  // namespace clearway
