// Frames to a server.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "clearway/client/connection.h"
#include "clearway/client/stream_state.h"
#include "clearway/scene/depth_image.h"
#include "clearway/scene/frame.h"
#include "clearway/wire/push_ack.h"

namespace clearway {

struct SenderOptions {
  // Of frames whose Frame::sensor_run is 0. 0: a random one for each sender, so that a program that
  // restarts may count sequences from 0 again.
  std::uint64_t sensor_run = 0;
  // Whether the server takes stamps further ahead than its max_stamp_jump_s.
  bool allow_stamp_jump = false;
};

// Not 0; from the system's source of random numbers.
std::uint64_t RandomSensorRun();

// Pushes frames, one at a time or as a stream. Pushing is idempotent: (sensor_id, sensor_run,
// sequence) names a frame, so that a retry after UNAVAILABLE never applies it twice. To repeat a
// frame by another sender, give both the same run. Push may be called from any thread; the stream's
// methods from one thread at a time.
class FrameSender {
 public:
  explicit FrameSender(std::shared_ptr<Connection> connection, const SenderOptions& options = {});
  ~FrameSender();  // abandons a stream that was not finished
  FrameSender(FrameSender&&) noexcept;
  FrameSender& operator=(FrameSender&&) noexcept;

  // Sends one frame and waits for `wait_for`.
  absl::StatusOr<PushAck> Push(const Frame& frame, AckLevel wait_for = AckLevel::kApplied);
  // Likewise, with an image in place of the frame's points: 2 bytes a pixel (3 with a mask, 4 if
  // its values need it) and not 16 a point. The server makes the points of it that SetPoints does.
  absl::StatusOr<PushAck> Push(const Frame& frame, const DepthImage& image,
                               AckLevel wait_for = AckLevel::kApplied);

  // What became of one frame of the stream: its names, and the answer or the refusal.
  using OnAck = std::function<void(const std::string& sensor_id, std::uint64_t sequence,
                                   const absl::StatusOr<PushAck>& answer)>;

  // Opens a stream. `on_ack` is called once per answered frame, in the order sent, from a thread of
  // the sender's own. When the connection is lost or the server restarts, the stream is opened
  // again, and frames without an answer are sent again in their order. With kAccepted, frames that
  // the server accepted but had not applied are lost with it.
  absl::Status OpenStream(OnAck on_ack, AckLevel wait_for = AckLevel::kApplied,
                          const ReconnectOptions& reconnect = {});
  // Queues the next frame; waits while the window (the server's max_frames_in_flight) is full, and
  // so while the connection is lost. An error means that the stream has ended, and says why.
  absl::Status Send(const Frame& frame);
  absl::Status Send(const Frame& frame, const DepthImage& image);
  // Waits for all answers and ends the stream. A frame that was sent but never answered is an
  // error.
  absl::Status CloseStream();

  StreamState state() const;       // of the open stream
  std::size_t unanswered() const;  // frames sent without an answer yet
  std::uint64_t sensor_run() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
