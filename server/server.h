// The server: its core behind gRPC.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/config.h"

namespace clearway {

struct ServerCore;

// A running server. Any thread may call any method; it ends with Drain or its destruction.
class Server {
 public:
  // Listens and serves. `config` must pass Validate. Errors are those of Listen, ReadTlsFiles and
  // TokenTable::Read.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const ServerConfig& config);
  ~Server();

  // Where it listens, with the port that was chosen.
  const std::string& address() const;
  ServerCore& core();

  // Turns health to NOT_SERVING, refuses new writes with UNAVAILABLE, applies what was
  // accepted, answers the calls that are running, and ends the streams. What is not done after
  // ServerConfig::drain ends with UNAVAILABLE. False if, within a second of that, a change was
  // still being applied or clients that read nothing still held connections: destroying the server
  // then waits for them, and a program that ends should leave at once.
  bool Drain();

  // Reads tokens and certificates again. Calls of clients that may no longer make them end with
  // UNAUTHENTICATED or PERMISSION_DENIED; other calls and all connections go on. An error of
  // ReadTlsFiles or TokenTable::Read changes nothing. One thread at a time.
  absl::Status Reload();

 private:
  struct Impl;
  explicit Server(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
