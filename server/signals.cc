#include "server/signals.h"

#include <pthread.h>
#include <unistd.h>

#include <thread>

namespace clearway {

Signals::Signals() {
  for (const int ignored : {SIGPIPE, SIGUSR1, SIGUSR2}) signal(ignored, SIG_IGN);
  sigemptyset(&waited_for_);
  for (const int taken : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&waited_for_, taken);
  pthread_sigmask(SIG_BLOCK, &waited_for_, &before_);
}

Signals::~Signals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

int Signals::Next() const {
  int number = 0;
  while (sigwait(&waited_for_, &number) != 0) {
  }
  return number;
}

void Signals::EndAtTheNext(int exit_code) const {
  sigset_t ending = waited_for_;
  sigdelset(&ending, SIGHUP);
  std::thread([ending, exit_code] {
    int number = 0;
    while (sigwait(&ending, &number) != 0) {
    }
    _exit(exit_code);  // whatever the other threads are at
  }).detach();
}

}  // namespace clearway
