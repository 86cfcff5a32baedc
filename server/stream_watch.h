// Ends streams whose client neither reads nor writes.
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
// it is about; a client that writes nothing keeps a thread, too. Any thread may call any method;
// contexts must outlive their turns.
class StreamWatch {
 public:
  // After so much time for a message that the server writes, or waits for, the stream ends with
  // UNAVAILABLE.
  StreamWatch(Duration for_reader, Duration for_writer);
  ~StreamWatch();
  StreamWatch(const StreamWatch&) = delete;
  StreamWatch& operator=(const StreamWatch&) = delete;

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
    StreamWatch& watch_;
    grpc::ServerContext& context_;
    std::list<Turn*>& turns_;  // of the watch
    const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
    bool ended_ = false;
    std::list<Turn*>::iterator place_;
  };

 private:
  struct Patience {
    Duration duration;
    std::string message;
  };
  void Run();
  static void EndOld(const std::list<Turn*>& turns, const Patience& patience);

  const Patience for_reader_, for_writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Turn*> writing_;  // the one that began first, first
  std::list<Turn*> reading_;
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
