// A server with a small scene, which is made anew whenever an input has changed it: so that an
// input does the same whatever came before.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

#include "server/server.h"
#include "support/temporary_folder.h"

namespace clearway::fuzz {

// One thread.
class ScratchServer {
 public:
  ScratchServer();

  // Sends the bytes as the one message of a call, which is given up after `patience`, and waits
  // until its handler has returned and what it put into the queue is applied. `method`:
  // "/clearway.v1.MapService/Reset".
  grpc::Status Call(const std::string& method, std::string_view bytes,
                    std::chrono::milliseconds patience);

  std::uint64_t version() const;
  // What is not of the scene: the robots, for example, which clients evict.
  void Restore();

 private:
  template <class Message>
  void Send(const std::string& method, const Message& message);
  void AwaitEnd() const;

  const TemporaryFolder folder_;
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace clearway::fuzz
