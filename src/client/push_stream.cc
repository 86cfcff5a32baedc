#include "client/push_stream.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "client/call.h"
#include "wire/frame_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Which start of the server answers; none if there is no server.
std::optional<std::string> InstanceOf(const grpc::ClientContext& context) {
  const auto& metadata = context.GetServerInitialMetadata();
  const auto found = metadata.find("clearway-server-instance");
  if (found == metadata.end()) return std::nullopt;
  return std::string(found->second.data(), found->second.size());
}

}  // namespace

PushStream::PushStream(const Connection::Impl& connection, Options options)
    : connection_(connection),
      options_(std::move(options)),
      reconnector_(options_.reconnect),
      thread_([this] { Run(); }) {}

PushStream::~PushStream() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
    if (context_ != nullptr) context_->TryCancel();
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

absl::Status PushStream::Send(v1::PushFramesRequest request) {
  request.set_wait_for(ToProto(options_.wait_for));
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return ended_ || pending_.size() < options_.window; });
  if (ended_) {
    return absl::UnavailableError(
        end_.ok() ? "the stream has ended"
                  : absl::StrCat("the stream has ended: ", std::string(end_.message())));
  }
  pending_.push_back({std::make_shared<const v1::PushFramesRequest>(std::move(request))});
  changed_.notify_all();
  return absl::OkStatus();
}

absl::Status PushStream::Close() {
  {
    std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
  return end_;
}

std::size_t PushStream::unanswered() const {
  std::lock_guard lock(mutex_);
  return pending_.size();
}

void PushStream::Run() {
  while (true) {
    const absl::Status status = RunOnce();
    const bool may_return = reconnector_.MayReturn(status);
    {
      std::lock_guard lock(mutex_);
      if (Finished(status)) return End(may_return ? absl::OkStatus() : status);
    }
    const std::optional<Duration> pause = may_return ? reconnector_.Lost(status) : std::nullopt;
    std::unique_lock lock(mutex_);
    if (!pause) return End(may_return ? reconnector_.GivenUp(status) : status);
    const auto nothing_left = [&] { return stop_ || (closing_ && pending_.empty()); };
    if (changed_.wait_for(lock, *pause, nothing_left)) return End(absl::OkStatus());
  }
}

// Nothing is left to be sent again.
bool PushStream::Finished(const absl::Status& status) {
  return stop_ || status.ok() || (closing_ && pending_.empty());
}

void PushStream::End(const absl::Status& status) {
  end_ = status;
  ended_ = true;
  changed_.notify_all();
}

// Opens a stream, sends what has no answer yet, and reads answers until the stream ends; says why.
absl::Status PushStream::RunOnce() {
  grpc::ClientContext context;
  {
    std::lock_guard lock(mutex_);
    if (stop_) return absl::CancelledError("the sender is ending");
    context_ = &context;
    broken_ = false;
    written_ = 0;
  }
  AwaitConnection(*connection_.channel, [this] {
    std::lock_guard lock(mutex_);
    return stop_;
  });
  const auto stream = connection_.ingest->PushFrames(&context);
  std::thread writer([&] { WriteFrames(*stream); });
  stream->WaitForInitialMetadata();
  if (const auto instance = InstanceOf(context)) reconnector_.Connected(*instance);
  const absl::Status refused = ReadAnswers(*stream);
  {
    std::lock_guard lock(mutex_);
    broken_ = true;
    for (std::size_t i = 0; i < written_; ++i) pending_[i].sent_before = true;
  }
  changed_.notify_all();
  if (!refused.ok()) context.TryCancel();  // and so a Write that waits
  writer.join();
  const absl::Status finished = FromGrpc(stream->Finish());
  std::lock_guard lock(mutex_);
  context_ = nullptr;
  if (!refused.ok()) return refused;
  // A server that shuts down ends or cancels streams, too; only after Close is that in order.
  const bool in_order = stop_ || (closing_ && pending_.empty());
  if (!in_order && (finished.ok() || absl::IsCancelled(finished))) {
    return absl::UnavailableError("the server ended the stream");
  }
  return finished;
}

// Until the stream ends, or a frame is refused because the server is going away.
absl::Status PushStream::ReadAnswers(Stream& stream) {
  v1::PushFramesResponse response;
  while (stream.Read(&response)) {
    if (response.has_error()) {
      absl::Status error = FromProto(response.error());
      if (absl::IsUnavailable(error)) return error;
    }
    Answer(response);
  }
  return absl::OkStatus();
}

void PushStream::Answer(const v1::PushFramesResponse& response) {
  absl::StatusOr<PushAck> answer = response.has_error()
                                       ? absl::StatusOr<PushAck>(FromProto(response.error()))
                                       : ReadPushAck(response.ack());
  {
    std::lock_guard lock(mutex_);
    // That this stream had sent it before is no news to the caller.
    if (answer.ok() && !pending_.empty() && pending_.front().sent_before) {
      answer->repeated_answer = false;
    }
  }
  options_.on_ack(response.sensor_id(), response.sequence(), answer);
  std::lock_guard lock(mutex_);
  if (!pending_.empty()) pending_.pop_front();
  if (written_ > 0) --written_;
  changed_.notify_all();
}

void PushStream::WriteFrames(Stream& stream) {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return broken_ || closing_ || written_ < pending_.size(); });
    if (broken_) return;
    if (written_ == pending_.size()) break;
    const auto request = pending_[written_++].request;
    lock.unlock();
    const bool sent = stream.Write(*request);
    lock.lock();
    if (!sent) return;  // the reader learns why
  }
  lock.unlock();
  stream.WritesDone();
}

}  // namespace clearway
