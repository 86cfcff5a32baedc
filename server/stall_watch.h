// Ends the streams of clients that do not read.
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
// it is about. Any thread may call any method; contexts must outlive their turns.
class StallWatch {
 public:
  // After so much time without a byte read, the stream ends with UNAVAILABLE.
  explicit StallWatch(Duration patience);
  ~StallWatch();
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;

  // Lives while its stream writes one message.
  class Turn {
   public:
    Turn(StallWatch& watch, grpc::ServerContext& context);
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    friend class StallWatch;
    StallWatch& watch_;
    grpc::ServerContext& context_;
    const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
    bool ended_ = false;
    std::list<Turn*>::iterator place_;
  };

 private:
  void Run();

  const Duration patience_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Turn*> turns_;  // the one that began first, first
  bool stop_ = false;
  std::thread thread_;
};

// Writes one message of a stream. False once its client has gone, or does not read.
template <class Stream, class Message>
bool WriteTo(Stream& stream, const Message& message, grpc::ServerContext& context,
             StallWatch& watch) {
  const StallWatch::Turn turn(watch, context);
  return stream.Write(message);
}

}  // namespace clearway
