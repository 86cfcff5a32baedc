// A Clearway server as a child process.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace clearway::demo {

// A running server, listening on a Unix socket in a folder of its own. Used by one thread.
class ServerProcess {
 public:
  // Starts `binary` with --listen and the given flags. Does not wait until it serves:
  // Connection::Open does.
  static absl::StatusOr<std::unique_ptr<ServerProcess>> Start(
      const std::string& binary, const std::vector<std::string>& flags);
  // Ends the server if Stop did not.
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  const std::string& address() const { return address_; }
  pid_t pid() const { return pid_; }

  // SIGTERM, and waits until the server has drained. INTERNAL if it did not exit with 0.
  absl::Status Stop();

 private:
  ServerProcess(std::string folder, std::string address, pid_t pid)
      : folder_(std::move(folder)), address_(std::move(address)), pid_(pid) {}

  std::string folder_;
  std::string address_;
  pid_t pid_;  // 0 once it has ended
};

}  // namespace clearway::demo
