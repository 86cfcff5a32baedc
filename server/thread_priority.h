// How much a thread counts when more want to run than there are processors. Linux only; where the
// system refuses, nothing changes.
#pragma once

#include <time.h>

#include <optional>

namespace clearway {

// Lets the calling thread, and the threads that it starts from now on, run as soon as they have
// something to do, for short turns, and thereby before others that are as important. From Linux
// 6.12 on: https://docs.kernel.org/scheduler/sched-eevdf.html.
void PreferShortTurns();

// Gives the calling thread a smaller share, from 0 (as others) to 19.
void GiveWay(int niceness);

// Lets others in while the thread that made it computes for long. A kernel looks only at its ticks,
// 1 to 10 ms apart, whether a thread's turn is over; a running alarm makes it look each 0.25 ms.
class TurnAlarm {
 public:
  TurnAlarm();  // not running; on the thread it is for, which must not end while it runs
  ~TurnAlarm();
  TurnAlarm(const TurnAlarm&) = delete;
  TurnAlarm& operator=(const TurnAlarm&) = delete;

  // On any thread, one at a time.
  void Start();
  void Stop();

  // What it signals the thread with. A handler that a program has set before stays.
  static int Signal();

 private:
  std::optional<timer_t> timer_;
};

}  // namespace clearway
