#include "clients/server_process.h"

#include <signal.h>
#include <unistd.h>

#include <array>

#include "clients/subprocess.h"

namespace clearway {

ServerProcess::ServerProcess(const std::vector<std::string>& flags, const std::string& listen) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return;
  pid_ = fork();
  if (pid_ == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    std::vector<std::string> arguments = {CLEARWAY_SERVER_BINARY, "--listen", listen, "--log-level",
                                          "warning"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    Exec(arguments);
  }
  close(ends[1]);
  out_ = ends[0];
  // "listening on 127.0.0.1:41234"
  std::string line;
  for (char c = 0; read(out_, &c, 1) == 1 && c != '\n';) line += c;
  if (const std::size_t at = line.rfind(' '); at != std::string::npos)
    address_ = line.substr(at + 1);
}

ServerProcess::~ServerProcess() {
  if (pid_ > 0) {
    kill(pid_, SIGTERM);
    WaitFor(pid_);
  }
  if (out_ >= 0) close(out_);
}

}  // namespace clearway
