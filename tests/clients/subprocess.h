// Programs run by tests.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace clearway {

// How a program ended and what it wrote.
struct Finished {
  int exit_code = -1;  // 128 + the signal if one ended it
  std::string out;
  std::string err;
};

// Runs a program to its end.
Finished RunProgram(const std::vector<std::string>& arguments, const std::string& input = "");

// The same, with SIGINT as soon as `now` says so, which is asked every 10 ms
// for 10 s.
Finished InterruptProgram(const std::vector<std::string>& arguments,
                          const std::function<bool()>& now);

// In a child process: becomes the program, or ends with 127.
[[noreturn]] void Exec(const std::vector<std::string>& arguments);
// The exit code of a child, once it has ended.
int WaitFor(pid_t pid);

}  // namespace clearway
