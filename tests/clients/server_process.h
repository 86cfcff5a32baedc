// The real server, for tests.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace clearway {

// clearway-server on a free port of loopback until the object is destroyed.
class ServerProcess {
 public:
  explicit ServerProcess(const std::vector<std::string>& flags = {},
                         const std::string& listen = "127.0.0.1:0");
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  // Empty if it did not start.
  const std::string& address() const { return address_; }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  int out_ = -1;
  std::string address_;
};

}  // namespace clearway
