#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "server/content_hash.h"
#include "server/handler.h"
#include "server/services.h"
#include "wire/frame_wire.h"

namespace clearway {
namespace {

// A frame in the queue, or one of its name whose answer is remembered.
struct Accepted {
  Ingestor::Ticket ticket;
  AckLevel wait_for = AckLevel::kApplied;
};

// Of PushFrame and PushFrames alike. push(PushedFrame) puts a frame into the queue.
template <class Request, class Push>
absl::StatusOr<Accepted> Accept(ServerCore& core, const Request& request, Push&& push) {
  if (core.draining) return DrainingError();
  RequestMemory::Share memory = ShareOf(core, request);
  if (!memory.status().ok()) return memory.status();
  absl::StatusOr<AckLevel> level = ReadAckLevel("wait_for", request.wait_for());
  if (!level.ok()) return level.status();
  if (*level == AckLevel::kDurable) {
    return WithReason(absl::FailedPreconditionError(
                          "wait_for: this server keeps no journal; APPLIED is the most it reaches"),
                      "NO_JOURNAL");
  }
  if (!request.has_frame()) return FieldError("frame", "is missing");
  const v1::Frame& proto = request.frame();
  const std::uint64_t hash = ContentHash(proto);
  // Before it is converted, which costs more. What lacks a field was never accepted.
  if (auto repeated = core.ingestor.FindRepeated(
          {proto.sensor_id(), proto.sensor_run(), proto.sequence()},
          {TimeFromNanoseconds(proto.stamp_ns()), hash}, request.allow_stamp_jump())) {
    return Accepted{*std::move(repeated), *level};
  }
  absl::StatusOr<Frame> frame = ReadFrame("frame", proto, FrameLimitsOf(core.config.limits));
  if (!frame.ok()) {
    core.ingestor.CountRefused();
    return frame.status();
  }
  absl::StatusOr<Ingestor::Ticket> ticket =
      push(PushedFrame{*std::move(frame), hash, request.allow_stamp_jump(), std::move(memory)});
  if (!ticket.ok()) return ticket.status();
  return Accepted{*std::move(ticket), *level};
}

// The answer at the level asked for, or the first answer if it is there already.
absl::StatusOr<PushAck> AnswerOf(const ServerCore& core, const Accepted& accepted,
                                 const Gone& gone) {
  const Ingestor::Ticket& ticket = accepted.ticket;
  if (accepted.wait_for == AckLevel::kAccepted && !(ticket.repeated && ticket.Answered())) {
    const ScenePtr scene = core.versions.Newest();
    return PushAck{{scene->version, scene->stamp}, AckLevel::kAccepted, {}, ticket.repeated};
  }
  Ingestor::Answer answer = Ingestor::Wait(ticket, gone);
  // What the scene refuses names a field of the frame; what has a reason is the server's own.
  const bool names_field = !answer.ok() && ReasonOf(answer.status()).empty();
  return names_field ? WithFieldPrefix("frame.", answer.status()) : answer;
}

// The answers that a push stream still owes, in order; written by a thread of its own, so that
// reading goes on meanwhile, at most `window` frames ahead.
class AnswerWriter {
 public:
  using Stream = grpc::ServerReaderWriter<v1::PushFramesResponse, v1::PushFramesRequest>;

  AnswerWriter(ServerCore& core, Stream& stream, std::size_t window, grpc::ServerContext& context)
      : core_(core),
        stream_(stream),
        window_(window),
        context_(context),
        gone_(GoneOf(core, &context)),
        thread_([this] { Run(); }) {}

  ~AnswerWriter() { Finish(); }

  // Waits while the window is full.
  void Owe(const v1::Frame& frame, absl::StatusOr<Accepted> accepted) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return owed_.size() < window_; });
    owed_.push_back(
        {{frame.sensor_id(), frame.sensor_run(), frame.sequence()}, std::move(accepted)});
    changed_.notify_all();
  }

  // Writes what is owed and ends.
  void Finish() {
    {
      std::lock_guard lock(mutex_);
      finishing_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

 private:
  struct Owed {
    FrameName name;
    absl::StatusOr<Accepted> accepted;
  };

  void Run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return finishing_ || !owed_.empty(); });
      if (owed_.empty()) return;
      const Owed owed = owed_.front();
      lock.unlock();
      // If the client has gone, so has the answer's reader.
      WriteTo(stream_, ResponseTo(owed), context_, core_.streams);
      lock.lock();
      owed_.pop_front();
      changed_.notify_all();
    }
  }

  v1::PushFramesResponse ResponseTo(const Owed& owed) const {
    v1::PushFramesResponse response;
    response.set_sensor_id(owed.name.sensor_id);
    response.set_sensor_run(owed.name.sensor_run);
    response.set_sequence(owed.name.sequence);
    const absl::StatusOr<PushAck> answer =
        owed.accepted.ok() ? AnswerOf(core_, *owed.accepted, gone_) : owed.accepted.status();
    if (answer.ok()) {
      Write(*answer, response.mutable_ack());
    } else {
      *response.mutable_error() = ToProto(answer.status());
    }
    return response;
  }

  ServerCore& core_;
  Stream& stream_;
  const std::size_t window_;
  grpc::ServerContext& context_;
  const Gone gone_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Owed> owed_;
  bool finishing_ = false;
  std::thread thread_;
};

}  // namespace

grpc::Status IngestHandlers::PushFrame(grpc::ServerContext* context,
                                       const v1::PushFrameRequest* request,
                                       v1::PushFrameResponse* response) {
  return HandleUnary(core_, context, "PushFrame", *request, *response, [&]() -> absl::Status {
    absl::StatusOr<Accepted> accepted = Accept(core_, *request, [&](PushedFrame pushed) {
      return core_.ingestor.Push(std::move(pushed));
    });
    if (!accepted.ok()) return accepted.status();
    absl::StatusOr<PushAck> ack = AnswerOf(core_, *accepted, GoneOf(core_, context));
    if (!ack.ok()) return ack.status();
    Write(*ack, response);
    return absl::OkStatus();
  });
}

grpc::Status IngestHandlers::PushFrames(
    grpc::ServerContext* context,
    grpc::ServerReaderWriter<v1::PushFramesResponse, v1::PushFramesRequest>* stream) {
  return HandleStream(core_, context, "PushFrames", [&](const Peer& peer) -> absl::Status {
    const ServerLimits& limits = core_.config.limits;
    const Quota::Slot slot(core_.push_streams, peer.name);
    if (!slot.status().ok()) return slot.status();
    if (core_.draining) return DrainingError();
    // Tells the client that the stream is open before there is anything to answer.
    context->AddInitialMetadata("clearway-server-instance", core_.instance);
    stream->SendInitialMetadata();
    const Gone gone = GoneOf(core_, context);
    AnswerWriter answers(core_, *stream, limits.max_frames_in_flight, *context);
    v1::PushFramesRequest request;
    Received received;
    while ((received = ReadNext(*stream, request, *context, core_.streams)) == Received::kMessage) {
      answers.Owe(request.frame(), Accept(core_, request, [&](PushedFrame pushed) {
                    return core_.ingestor.PushWhenRoom(std::move(pushed), gone);
                  }));
    }
    answers.Finish();  // before the call ends with a status
    return received == Received::kGarbage ? GarbageError() : absl::OkStatus();
  });
}

}  // namespace clearway
