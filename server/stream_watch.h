// Ends streams that wait for their client: those that do not read, and all when the server ends.
#pragma once

#include <grpcpp/server_context.h>

#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "clearway/base/time.h"

namespace clearway {

// A message that its client does not read blocks the thread that writes it, and holds the version
// it is about; a thread that reads waits until its client writes. gRPC alone would end both with
// CANCELLED, or UNAVAILABLE, as it happens. Any thread may call any method; contexts must outlive
// their turns.
class StreamWatch {
 public:
  // After so much time without a byte read, the stream ends with UNAVAILABLE.
  explicit StreamWatch(Duration patience);
  ~StreamWatch();
  StreamWatch(const StreamWatch&) = delete;
  StreamWatch& operator=(const StreamWatch&) = delete;

  // Streams that wait for their client end with UNAVAILABLE, and so do those that come to wait.
  void EndAll(const std::string& message);

  enum class For { kReading, kWriting };

  // Lives while its stream reads or writes one message.
  class Turn {
   public:
    Turn(StreamWatch& watch, grpc::ServerContext& context, For what);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    friend class StreamWatch;
    void End(const std::string& message);  // under the watch's mutex

    StreamWatch& watch_;
    grpc::ServerContext& context_;
    std::list<Turn*>& turns_;
    const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
    bool ended_ = false;
    std::list<Turn*>::iterator place_;
  };

 private:
  void Run();

  const Duration patience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Turn*> writing_;  // the one that began first, first
  std::list<Turn*> reading_;
  std::string all_end_;  // why; empty until they do
  bool stop_ = false;
  std::thread thread_;
};

// Writes one message of a stream. False once its client has gone, or does not read.
template <class Stream, class Message>
bool WriteTo(Stream& stream, const Message& message, grpc::ServerContext& context,
             StreamWatch& watch) {
  const StreamWatch::Turn turn(watch, context, StreamWatch::For::kWriting);
  return stream.Write(message);
}

}  // namespace clearway
