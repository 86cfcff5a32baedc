// A stream of frames that survives a lost connection.
#pragma once

#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "clearway/client/frame_sender.h"
#include "clearway/v1/ingest_service.grpc.pb.h"
#include "client/call.h"
#include "client/reconnector.h"

namespace clearway {

// Keeps every frame until it is answered. When the stream breaks, or the server refuses a frame
// because it is going away, a new stream is opened and the frames without an answer are sent again
// in their order; their names keep them from being applied twice. One thread may call Send and
// Close; any thread the rest.
class PushStream {
 public:
  struct Options {
    std::size_t window = 1;  // frames without an answer
    AckLevel wait_for = AckLevel::kApplied;
    FrameSender::OnAck on_ack;
    ReconnectOptions reconnect;
  };
  // `connection` must outlive the stream.
  PushStream(const Connection::Impl& connection, Options options);
  ~PushStream();  // abandons what is not answered

  // Waits while the window is full; UNAVAILABLE once the stream has ended, with the reason.
  absl::Status Send(v1::PushFramesRequest request);
  // Waits for all answers; says why the stream ended if not all came.
  absl::Status Close();

  std::size_t unanswered() const;
  StreamState state() const { return reconnector_.state(); }

 private:
  using Stream = grpc::ClientReaderWriter<v1::PushFramesRequest, v1::PushFramesResponse>;
  struct Pending {
    std::shared_ptr<const v1::PushFramesRequest> request;
    bool sent_before = false;  // on a stream that broke
  };

  void Run();
  absl::Status RunOnce();
  absl::Status ReadAnswers(Stream& stream);
  void WriteFrames(Stream& stream);
  void Answer(const v1::PushFramesResponse& response);
  bool Finished(const absl::Status& status);  // with the lock held
  void End(const absl::Status& status);

  const Connection::Impl& connection_;
  const Options options_;
  Reconnector reconnector_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Pending> pending_;             // frames without an answer
  std::size_t written_ = 0;                 // of the first of them, to the stream that is open
  grpc::ClientContext* context_ = nullptr;  // of the stream that is open
  bool broken_ = false;                     // the stream that is open takes no more frames
  bool closing_ = false, stop_ = false, ended_ = false;
  absl::Status end_;  // how it ended
  std::thread thread_;
};

}  // namespace clearway
