#include "server/thread_priority.h"

#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <mutex>

namespace clearway {
namespace {

constexpr std::uint64_t kShortTurn_ns = 100'000;  // the shortest there is
constexpr long kAlarm_ns = 250'000;

// The kernel's sched_attr, https://man7.org/linux/man-pages/man2/sched_setattr.2.html: its header
// cannot be included beside the C library's.
struct Attributes {
  std::uint32_t size, policy;
  std::uint64_t flags;
  std::int32_t nice;
  std::uint32_t priority;
  std::uint64_t runtime_ns, deadline_ns, period_ns;
};

// Of the calling thread. change(Attributes&).
template <class Change>
void ChangeScheduling(Change&& change) {
  Attributes attributes{};
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
  change(attributes);
  (void)syscall(SYS_sched_setattr, 0, &attributes, 0);
}

// To tell a thread's time the kernel updates it, and sees that its turn is over: at the end of this
// another thread runs, if one waits.
void LookAtTime(int) {
  const int error = errno;
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  errno = error;
}

void Handle() {
  struct sigaction action {};
  if (sigaction(TurnAlarm::Signal(), nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  action.sa_handler = LookAtTime;
  action.sa_flags = SA_RESTART;
  sigaction(TurnAlarm::Signal(), &action, nullptr);
}

void SetPeriod(timer_t timer, long period_ns) {
  itimerspec periods{};
  periods.it_interval.tv_nsec = periods.it_value.tv_nsec = period_ns;
  timer_settime(timer, 0, &periods, nullptr);
}

}  // namespace

void PreferShortTurns() {
  ChangeScheduling([](Attributes& attributes) { attributes.runtime_ns = kShortTurn_ns; });
}

void GiveWay(int niceness) {
  ChangeScheduling(
      [&](Attributes& attributes) { attributes.nice = std::max(attributes.nice, niceness); });
}

TurnAlarm::TurnAlarm() {
  static std::once_flag handled;
  std::call_once(handled, Handle);
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = Signal();
  event._sigev_un._tid = static_cast<pid_t>(syscall(SYS_gettid));  // glibc 2.36 has no other name
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) == 0) timer_ = timer;
}

TurnAlarm::~TurnAlarm() {
  if (timer_) timer_delete(*timer_);
}

void TurnAlarm::Start() {
  if (timer_) SetPeriod(*timer_, kAlarm_ns);
}

void TurnAlarm::Stop() {
  if (timer_) SetPeriod(*timer_, 0);
}

int TurnAlarm::Signal() { return SIGRTMIN + 4; }

}  // namespace clearway
