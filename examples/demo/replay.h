// Frames to the server, with a progress bar.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>

#include "absl/status/status.h"
#include "clearway/client/connection.h"
#include "clearway/client/frame_sender.h"
#include "clearway/io/frame_source.h"

namespace clearway::demo {

// What has been replayed so far.
struct ReplayTotals {
  std::size_t frames = 0;
  std::uint64_t points = 0;
  double seconds = 0;         // of this computer's clock
  std::uint64_t version = 0;  // of the scene, with the last frame in it
};

// Streams a source piece by piece. Used by one thread.
class Replay {
 public:
  // `source` must outlive this.
  Replay(std::shared_ptr<Connection> connection, const FrameSource& source, std::ostream& out,
         bool is_terminal);

  // Sends the frames up to and including `last_frame`, and waits until the server has applied
  // them. The error is the source's, the transport's, or the first refusal of a frame.
  absl::Status Through(std::size_t last_frame);

  const ReplayTotals& totals() const { return totals_; }

 private:
  const FrameSource& source_;
  std::ostream& out_;
  bool is_terminal_;
  FrameSender sender_;
  ReplayTotals totals_;
};

}  // namespace clearway::demo
