#include "server/thread_priority.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

namespace clearway {
namespace {

constexpr std::uint64_t kShortTurn_ns = 100'000;  // the shortest there is
constexpr std::uint64_t kUsualTurn = 0;

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

}  // namespace

void PreferShortTurns() {
  ChangeScheduling([](Attributes& attributes) { attributes.runtime_ns = kShortTurn_ns; });
}

void GiveWay(int niceness) {
  ChangeScheduling([&](Attributes& attributes) {
    attributes.runtime_ns = kUsualTurn;
    attributes.nice = std::max(attributes.nice, niceness);
  });
}

}  // namespace clearway
