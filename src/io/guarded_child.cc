#include "io/guarded_child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>
#include <string>

namespace clearway {
namespace {

constexpr int kReplyDescriptor = 3;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif
#else
constexpr bool kIsSanitized = false;
#endif

// The caller's handlers would run on the caller's data.
void ResetSignals() {
  struct sigaction standard = {};
  standard.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) sigaction(signal, &standard, nullptr);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

// Sockets, locks and pipes of the caller must not outlive it in here. What libraries print when
// they abort is nobody's to read.
void KeepOnly(int descriptor) {
  if (descriptor != kReplyDescriptor) dup2(descriptor, kReplyDescriptor);
  const int nothing = open("/dev/null", O_RDWR);
  for (int standard = 0; standard < kReplyDescriptor; ++standard) dup2(nothing, standard);
  constexpr unsigned kFirst = kReplyDescriptor + 1;
  if (close_range(kFirst, ~0U, 0) == 0) return;
  for (int other = kFirst; other < 4096; ++other) close(other);  // a kernel before 5.9
}

template <class Resource>
void Lower(Resource resource, rlim_t most) {
  rlimit limit;
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  setrlimit(resource, &limit);
}

// Of this process; 0 if it is not known.
rlim_t AddressSpaceBytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void SetLimits(const CallLimits& limits) {
  const rlim_t used = AddressSpaceBytes();
  if (GuardsMemory() && used > 0 && limits.max_memory_bytes < RLIM_INFINITY - used) {
    Lower(RLIMIT_AS, used + limits.max_memory_bytes);
  }
  // The caller looks at the clock; this is for the case that it cannot any more.
  Lower(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(ToSeconds(limits.max_time))) + 1);
  Lower(RLIMIT_CORE, 0);
  prctl(PR_SET_DUMPABLE, 0);  // programs that collect core dumps do not heed the limit
}

void Send(const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = write(kReplyDescriptor, at, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) _exit(1);
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

}  // namespace

bool GuardsMemory() { return !kIsSanitized; }

void RunGuardedChild(int descriptor, pid_t parent, const CallLimits& limits,
                     const std::function<absl::StatusOr<std::string>()>& function) noexcept {
  KeepOnly(descriptor);
  SetLimits(limits);
  ResetSignals();
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // end with the thread that waits
  if (getppid() != parent) _exit(1);
  GuardedReply reply;
  std::string bytes;
  try {
    absl::StatusOr<std::string> result = function();
    reply.kind = static_cast<std::uint64_t>(result.status().code());
    bytes = result.ok() ? *std::move(result) : std::string(result.status().message());
  } catch (const std::bad_alloc&) {
    reply.kind = kReplyNoMemory;
  } catch (const std::exception& error) {
    reply.kind = kReplyThrew;
    bytes = error.what();
  } catch (...) {
    reply.kind = kReplyThrew;
    bytes = "an unknown exception";
  }
  reply.bytes = bytes.size();
  Send(&reply, sizeof reply);
  Send(bytes.data(), bytes.size());
  _exit(0);
}

}  // namespace clearway
