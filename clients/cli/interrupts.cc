#include "cli/interrupts.h"

#include <utility>

namespace clearway::cli {
namespace {

sigset_t Signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGHUP);
  return signals;
}

void Mask(int how) {
  const sigset_t signals = Signals();
  pthread_sigmask(how, &signals, nullptr);
}

}  // namespace

SignalsBlocked::SignalsBlocked() { Mask(SIG_BLOCK); }
SignalsBlocked::~SignalsBlocked() { Mask(SIG_UNBLOCK); }

SignalWatch::SignalWatch(std::function<void()> act)
    : act_(std::move(act)), thread_([this] { Run(); }) {}

SignalWatch::~SignalWatch() {
  over_ = true;
  pthread_kill(thread_.native_handle(), SIGTERM);  // wakes it
  thread_.join();
}

void SignalWatch::Run() {
  const sigset_t signals = Signals();
  int signal = 0;
  sigwait(&signals, &signal);
  if (over_) return;
  act_();
  Mask(SIG_UNBLOCK);
  raise(signal);
}

}  // namespace clearway::cli
