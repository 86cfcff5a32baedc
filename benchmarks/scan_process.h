// Scans of a real drive, from a process of their own.
#pragma once

#include <sys/types.h>

#include <string>

namespace clearway::bench {

// Pushes scans to a server, as a sensor's process would: a benchmark's own calls then share neither
// its threads nor its sockets. One thread.
class ScanProcess {
 public:
  // Forks; to be made before any thread.
  ScanProcess();
  ~ScanProcess();
  ScanProcess(const ScanProcess&) = delete;
  ScanProcess& operator=(const ScanProcess&) = delete;

  // Connects. To be called once, before the rest.
  void Connect(const std::string& address);
  // Pushes `scans` one after the other.
  void Push(int scans);
  // Pushes one each 0.1 s, or as soon as the one before is applied if that is later.
  void Start();
  // Returns how many that were.
  int Stop();

  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  int to_child_ = -1, from_child_ = -1;
};

}  // namespace clearway::bench
