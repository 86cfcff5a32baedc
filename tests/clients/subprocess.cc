#include "clients/subprocess.h"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "support/temporary_folder.h"

namespace clearway {

void Exec(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  unsetenv("CLEARWAY_ADDRESS");
  execv(argv[0], argv.data());
  _exit(127);
}

int WaitFor(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

namespace {

// Files instead of pipes: no program can block on what nobody reads.
void Redirect(const std::filesystem::path& file, const char* mode, FILE* stream) {
  if (freopen(file.c_str(), mode, stream) == nullptr) _exit(127);
}

// `meanwhile(pid)` is called once it runs.
Finished Run(const std::vector<std::string>& arguments, const std::string& input,
             const std::function<void(pid_t)>& meanwhile) {
  const TemporaryFolder folder;
  folder.Write("in", input);
  const pid_t pid = fork();
  if (pid == 0) {
    Redirect(folder / "in", "r", stdin);
    Redirect(folder / "out", "w", stdout);
    Redirect(folder / "err", "w", stderr);
    Exec(arguments);
  }
  meanwhile(pid);
  Finished finished;
  finished.exit_code = WaitFor(pid);
  finished.out = BytesOf(folder / "out");
  finished.err = BytesOf(folder / "err");
  return finished;
}

}  // namespace

Finished RunProgram(const std::vector<std::string>& arguments, const std::string& input) {
  return Run(arguments, input, [](pid_t) {});
}

Finished InterruptProgram(const std::vector<std::string>& arguments,
                          const std::function<bool()>& now) {
  return Run(arguments, "", [&](pid_t pid) {
    for (int look = 0; look < 1000 && !now(); ++look) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill(pid, SIGINT);
  });
}

}  // namespace clearway
