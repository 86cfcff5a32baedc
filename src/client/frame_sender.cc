#include "clearway/client/frame_sender.h"

#include <algorithm>
#include <random>
#include <utility>

#include "client/call.h"
#include "client/push_stream.h"
#include "wire/frame_wire.h"

namespace clearway {

struct FrameSender::Impl {
  // Of both kinds of push.
  template <class Request>
  void Finish(Request& request) const {
    v1::Frame& frame = *request.mutable_frame();
    if (frame.sensor_run() == 0) frame.set_sensor_run(options.sensor_run);
    request.set_allow_stamp_jump(options.allow_stamp_jump);
  }
  absl::StatusOr<PushAck> Push(v1::PushFrameRequest request, AckLevel wait_for) const {
    Finish(request);
    request.set_wait_for(ToProto(wait_for));
    auto response = Call(connection->options(), *connection->impl().ingest,
                         &v1::IngestService::Stub::PushFrame, request);
    if (!response.ok()) return response.status();
    return ReadPushAck(*response);
  }
  // Sends the frame that `fill` makes.
  template <class Fill>
  absl::Status Send(Fill&& fill) const {
    if (stream == nullptr) return absl::FailedPreconditionError("no stream is open");
    v1::PushFramesRequest request;
    fill(request.mutable_frame());
    Finish(request);
    return stream->Send(std::move(request));
  }

  std::shared_ptr<Connection> connection;
  SenderOptions options;
  std::unique_ptr<PushStream> stream;
};

std::uint64_t RandomSensorRun() {
  std::random_device random;
  std::uint64_t run = 0;
  while (run == 0) run = std::uint64_t{random()} << 32 | random();
  return run;
}

FrameSender::FrameSender(std::shared_ptr<Connection> connection, const SenderOptions& options)
    : impl_(std::make_unique<Impl>(Impl{std::move(connection), options, nullptr})) {
  if (options.sensor_run == 0) impl_->options.sensor_run = RandomSensorRun();
}
FrameSender::~FrameSender() = default;
FrameSender::FrameSender(FrameSender&&) noexcept = default;
FrameSender& FrameSender::operator=(FrameSender&&) noexcept = default;

absl::StatusOr<PushAck> FrameSender::Push(const Frame& frame, AckLevel wait_for) {
  v1::PushFrameRequest request;
  Write(frame, request.mutable_frame());
  return impl_->Push(std::move(request), wait_for);
}

absl::StatusOr<PushAck> FrameSender::Push(const Frame& frame, const DepthImage& image,
                                          AckLevel wait_for) {
  v1::PushFrameRequest request;
  Write(frame, image, request.mutable_frame());
  return impl_->Push(std::move(request), wait_for);
}

absl::Status FrameSender::OpenStream(OnAck on_ack, AckLevel wait_for,
                                     const ReconnectOptions& reconnect) {
  if (impl_->stream != nullptr) return absl::FailedPreconditionError("a stream is already open");
  PushStream::Options options;
  options.window =
      std::max<std::uint64_t>(1, impl_->connection->server().limits.max_frames_in_flight);
  options.wait_for = wait_for;
  options.on_ack = std::move(on_ack);
  options.reconnect = reconnect;
  impl_->stream = std::make_unique<PushStream>(impl_->connection->impl(), std::move(options));
  return absl::OkStatus();
}

absl::Status FrameSender::Send(const Frame& frame) {
  return impl_->Send([&](v1::Frame* proto) { Write(frame, proto); });
}

absl::Status FrameSender::Send(const Frame& frame, const DepthImage& image) {
  return impl_->Send([&](v1::Frame* proto) { Write(frame, image, proto); });
}

absl::Status FrameSender::CloseStream() {
  if (impl_->stream == nullptr) return absl::FailedPreconditionError("no stream is open");
  const absl::Status status = impl_->stream->Close();
  impl_->stream.reset();
  return status;
}

StreamState FrameSender::state() const {
  return impl_->stream == nullptr ? StreamState{} : impl_->stream->state();
}

std::uint64_t FrameSender::sensor_run() const { return impl_->options.sensor_run; }

std::size_t FrameSender::unanswered() const {
  return impl_->stream == nullptr ? 0 : impl_->stream->unanswered();
}

}  // namespace clearway
