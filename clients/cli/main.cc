// The command line tool `clearway`.
#include <sys/ioctl.h>
#include <unistd.h>

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
    if (clearway::NearestName(name.substr(prefix.size()), {"ADDRESS"}).empty()) continue;
    std::cerr << "note: environment: " << name << " is ignored; did you mean CLEARWAY_ADDRESS?\n";
  }
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
  return clearway::cli::RunCli(argc, argv, terminal);
}
