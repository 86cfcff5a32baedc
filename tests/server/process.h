// A clearway-server in a process of its own.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace clearway::testing_support {

// A running clearway-server with its output in a pipe. Killed with the object. One thread.
class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments,
                   std::vector<std::string> environment = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // Where it listens; empty if it ended instead.
  std::string Address();
  std::string RestOfOutput();
  // Nobody reads it any more.
  void CloseOutput();
  void Signal(int signal) const;
  // How many of its threads have each niceness.
  std::map<int, int> Nicenesses() const;
  pid_t id() const { return id_; }
  // The exit code; -1 if a signal ended it.
  int Wait();

 private:
  bool ReadLine(std::string& line);

  pid_t id_ = 0;
  FILE* output_ = nullptr;
  std::string seen_;
  bool ended_ = false;
};

}  // namespace clearway::testing_support
