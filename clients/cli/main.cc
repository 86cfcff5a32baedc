// The command line tool `clearway`.
#include <grpc/support/log.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "clearway/base/nearest_name.h"
#include "cli/cli.h"

extern char** environ;

namespace {

// A misspelt address would silently mean the default server.
void NoteMisspeltAddress() {
  const std::string prefix = "CLEARWAY_";
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    if (!name.starts_with(prefix) || name == prefix + "ADDRESS") continue;
    if (name == prefix + "TOKEN_FILE") continue;
    if (clearway::NearestName(name.substr(prefix.size()), {"ADDRESS"}).empty()) continue;
    std::cerr << "note: environment: " << name << " is ignored; did you mean CLEARWAY_ADDRESS?\n";
  }
}

// gRPC's own lines repeat what our messages say, in its words. Its variable brings them back.
void SilenceGrpc() {
  if (std::getenv("GRPC_VERBOSITY") == nullptr) gpr_set_log_function([](gpr_log_func_args*) {});
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  clearway::cli::Terminal terminal{std::cin, std::cout, std::cerr};
  terminal.err_is_terminal = isatty(STDERR_FILENO) != 0;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    terminal.columns = size.ws_col;
  NoteMisspeltAddress();
  SilenceGrpc();
  return clearway::cli::RunCli(argc, argv, terminal);
}
