#include "clearway/client/frame_sender.h"

#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/call.h"
#include "wire/frame_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

// One open stream and the thread that reads its answers.
class PushStream {
 public:
  PushStream(v1::IngestService::Stub& stub, std::size_t window, AckLevel wait_for,
             FrameSender::OnAck on_ack)
      : window_(window),
        wait_for_(wait_for),
        on_ack_(std::move(on_ack)),
        stream_(stub.PushFrames(&context_)),
        reader_([this] { ReadAnswers(); }) {}

  ~PushStream() {
    if (!reader_.joinable()) return;
    context_.TryCancel();
    reader_.join();
    (void)stream_->Finish();  // abandoned: the caller did not ask how it went
  }

  absl::Status Send(v1::PushFramesRequest request) {
    request.set_wait_for(ToProto(wait_for_));
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ended_ || unanswered_ < window_; });
      if (ended_) return absl::UnavailableError("the stream has ended");
      ++unanswered_;
    }
    if (!stream_->Write(request)) return absl::UnavailableError("the stream is broken");
    return absl::OkStatus();
  }

  absl::Status Close() {
    stream_->WritesDone();
    reader_.join();
    const absl::Status status = FromGrpc(stream_->Finish());
    if (!status.ok() || unanswered_ == 0) return status;
    return absl::DataLossError(
        absl::StrCat("the stream ended with ", unanswered_, " frames unanswered"));
  }

  std::size_t unanswered() const {
    std::lock_guard lock(mutex_);
    return unanswered_;
  }

 private:
  void ReadAnswers() {
    v1::PushFramesResponse response;
    while (stream_->Read(&response)) {
      if (response.has_error()) {
        on_ack_(response.sensor_id(), response.sequence(), FromProto(response.error()));
      } else {
        on_ack_(response.sensor_id(), response.sequence(), ReadPushAck(response.ack()));
      }
      std::lock_guard lock(mutex_);
      --unanswered_;
      changed_.notify_all();
    }
    std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  const std::size_t window_;
  const AckLevel wait_for_;
  const FrameSender::OnAck on_ack_;
  grpc::ClientContext context_;
  std::unique_ptr<grpc::ClientReaderWriter<v1::PushFramesRequest, v1::PushFramesResponse>> stream_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t unanswered_ = 0;
  bool ended_ = false;
  std::thread reader_;
};

}  // namespace

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

absl::Status FrameSender::OpenStream(OnAck on_ack, AckLevel wait_for) {
  if (impl_->stream != nullptr) return absl::FailedPreconditionError("a stream is already open");
  const std::size_t window =
      std::max<std::uint64_t>(1, impl_->connection->server().limits.max_frames_in_flight);
  impl_->stream = std::make_unique<PushStream>(*impl_->connection->impl().ingest, window, wait_for,
                                               std::move(on_ack));
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

std::uint64_t FrameSender::sensor_run() const { return impl_->options.sensor_run; }

std::size_t FrameSender::unanswered() const {
  return impl_->stream == nullptr ? 0 : impl_->stream->unanswered();
}

}  // namespace clearway
