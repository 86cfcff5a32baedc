// The command line tool `clearway`.
#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "cli/cli.h"

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  clearway::cli::Terminal terminal{std::cin, std::cout, std::cerr};
  terminal.err_is_terminal = isatty(STDERR_FILENO) != 0;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    terminal.columns = size.ws_col;
  return clearway::cli::RunCli(argc, argv, terminal);
}
