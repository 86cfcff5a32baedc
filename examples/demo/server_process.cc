#include "demo/server_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <thread>

#include "absl/strings/str_cat.h"

namespace clearway::demo {
namespace {

// The server listens once its socket is there; it loads and binds before, which a busy machine may
// draw out.
absl::Status WaitForSocket(const std::string& path, pid_t server) {
  for (int tries = 0; tries < 1500; ++tries) {
    if (std::filesystem::exists(path)) return absl::OkStatus();
    if (waitpid(server, nullptr, WNOHANG) != 0) {
      return absl::InternalError("the server ended before it listened; its message is above");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return absl::DeadlineExceededError("the server did not listen within 30 s");
}

}  // namespace

absl::StatusOr<std::unique_ptr<ServerProcess>> ServerProcess::Start(
    const std::string& binary, const std::vector<std::string>& flags) {
  // Short, for a socket's path may have 107 bytes at most.
  std::string folder = (std::filesystem::temp_directory_path() / "clearway-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    return absl::InternalError(absl::StrCat("cannot make ", folder, ": ", std::strerror(errno)));
  }
  const std::string address = absl::StrCat("unix:", folder, "/socket");
  std::vector<std::string> words{binary, absl::StrCat("--listen=", address)};
  words.insert(words.end(), flags.begin(), flags.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  pid_t pid = 0;
  posix_spawn_file_actions_t actions;  // its errors are for us to see, its greeting is not
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawn(&pid, binary.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    std::filesystem::remove_all(folder);
    return absl::NotFoundError(absl::StrCat("cannot start '", binary, "': ", std::strerror(error)));
  }
  std::unique_ptr<ServerProcess> process(new ServerProcess(folder, address, pid));
  const absl::Status listening = WaitForSocket(folder + "/socket", pid);
  if (!listening.ok()) return listening;
  return process;
}

ServerProcess::~ServerProcess() {
  Stop().IgnoreError();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

absl::Status ServerProcess::Stop() {
  if (pid_ == 0) return absl::OkStatus();
  kill(pid_, SIGTERM);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return absl::OkStatus();
  return absl::InternalError(WIFSIGNALED(status)
                                 ? absl::StrCat("the server was ended by signal ", WTERMSIG(status))
                                 : absl::StrCat("the server exited with ", WEXITSTATUS(status)));
}

}  // namespace clearway::demo
