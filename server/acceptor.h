// Takes connections in.
#pragma once

#include <grpcpp/server_builder.h>

#include <cstdint>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "server/descriptor.h"

namespace clearway {

// gRPC 1.51's own listeners know no limit, and accept nobody any more once descriptors have run out
// (CVE-2023-4785). This one refuses connections above a limit of its own, and those that would
// leave the process too few descriptors for anything else; when there are none at all, connections
// wait in the kernel's queue. One thread may use it; its own accepts.
class Acceptor {
 public:
  using Handler = grpc::experimental::ExternalConnectionAcceptor;

  // `handler` is asked from Start on, so its server must have been started.
  Acceptor(std::vector<Descriptor> listeners, std::unique_ptr<Handler> handler,
           std::uint64_t max_connections);
  ~Acceptor();
  Acceptor(const Acceptor&) = delete;
  Acceptor& operator=(const Acceptor&) = delete;

  void Start();
  // No connections from now on; those that wait are refused. May be called again.
  void Close();

 private:
  // A socket, by its number and inode: numbers are used again.
  using Connection = std::pair<int, std::uint64_t>;

  void Run();
  // False when there are no descriptors.
  bool TakeFrom(int listener);
  bool HasRoomFor(int fd);

  std::vector<Descriptor> listeners_;
  const std::unique_ptr<Handler> handler_;
  const std::uint64_t max_connections_;
  std::vector<Connection> connections_;  // the thread's own, with some that have ended
  Descriptor stop_;                      // becomes readable to end the thread
  std::thread thread_;
};

// Lets this process have as many descriptors as the system allows it.
void RaiseDescriptorLimit();

}  // namespace clearway
