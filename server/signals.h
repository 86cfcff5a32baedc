// The signals that tell a server to end or to read its files again.
#pragma once

#include <signal.h>

namespace clearway {

// While one lives, SIGTERM, SIGINT and SIGHUP are waited for instead of ending the process, in the
// thread that made it and in those that it starts from then on. SIGPIPE is ignored for good: it
// would end a server whose log nobody reads any more. So are SIGUSR1 and SIGUSR2.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // Waits for the next. Any one thread at a time.
  int Next() const;
  // From now on, SIGTERM or SIGINT ends the process at once, with `exit_code`.
  void EndAtTheNext(int exit_code) const;

 private:
  sigset_t waited_for_, before_;
};

}  // namespace clearway
