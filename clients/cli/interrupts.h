// What is to be done before Ctrl-C ends the tool.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
#include <thread>

namespace clearway::cli {

// While it lives, SIGINT, SIGTERM and SIGHUP wait, for this thread and those that it starts: make
// it before all others.
class SignalsBlocked {
 public:
  SignalsBlocked();
  ~SignalsBlocked();
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
};

// Takes the signals that are blocked: the first one calls `act`, on another thread, and then ends
// the process as it would have. Once the destructor is over, `act` is not called.
class SignalWatch {
 public:
  explicit SignalWatch(std::function<void()> act);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  void Run();

  std::function<void()> act_;
  std::atomic<bool> over_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace clearway::cli
