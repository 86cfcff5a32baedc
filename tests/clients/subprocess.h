// Programs run by tests.
#pragma once

#include <sys/types.h>

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

// In a child process: becomes the program, or ends with 127.
[[noreturn]] void Exec(const std::vector<std::string>& arguments);
// The exit code of a child, once it has ended.
int WaitFor(pid_t pid);

}  // namespace clearway
