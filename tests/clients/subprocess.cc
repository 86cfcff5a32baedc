#include "clients/subprocess.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

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

}  // namespace

Finished RunProgram(const std::vector<std::string>& arguments, const std::string& input) {
  const TemporaryFolder folder;
  folder.Write("in", input);
  const pid_t pid = fork();
  if (pid == 0) {
    Redirect(folder / "in", "r", stdin);
    Redirect(folder / "out", "w", stdout);
    Redirect(folder / "err", "w", stderr);
    Exec(arguments);
  }
  Finished finished;
  finished.exit_code = WaitFor(pid);
  finished.out = BytesOf(folder / "out");
  finished.err = BytesOf(folder / "err");
  return finished;
}

}  // namespace clearway
