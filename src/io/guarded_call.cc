#include "io/guarded_call.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "io/guarded_child.h"

namespace clearway {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
// How often to look whether the child has ended while something else keeps its pipe open.
constexpr Milliseconds kLook(50);
constexpr Duration kLongest = std::chrono::hours(24 * 365);

struct Descriptor {
  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { Close(); }
  void Close() {
    if (number >= 0) close(std::exchange(number, -1));
  }

  int number = -1;
};

// A child process from its fork on; its destructor ends it. The caller of the library may ignore
// SIGCHLD or wait for all children: then how this one ended is not known.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { End(); }

  bool HasEnded() {
    if (!has_ended_) Wait(WNOHANG);
    return has_ended_;
  }

  // A child that exits already keeps its status.
  void End() {
    if (HasEnded()) return;
    kill(id_, SIGKILL);
    Wait(0);
  }

  // The signal that killed it, if one did and that is known.
  std::optional<int> signal() const {
    if (!status_ || !WIFSIGNALED(*status_)) return std::nullopt;
    return WTERMSIG(*status_);
  }

 private:
  void Wait(int flags) {
    int status = 0;
    pid_t found = -1;
    do found = waitpid(id_, &status, flags);
    while (found < 0 && errno == EINTR);
    if (found == id_) status_ = status;
    has_ended_ = found != 0;
  }

  const pid_t id_;
  bool has_ended_ = false;
  std::optional<int> status_;
};

enum class Received { kAll, kTooMuch, kTimeIsUp };

bool IsTooLong(std::size_t bytes, std::uint64_t max_result_bytes) {
  return bytes > max_result_bytes && bytes - max_result_bytes > sizeof(GuardedReply);
}

// Gathers what the child sends until it sends no more.
Received Receive(int descriptor, Clock::time_point end, std::uint64_t max_result_bytes,
                 Child& child, std::string& bytes) {
  std::vector<char> piece(kPieceBytes);
  while (!IsTooLong(bytes.size(), max_result_bytes)) {
    const auto left = std::chrono::ceil<Milliseconds>(end - Clock::now());
    if (left.count() <= 0) return Received::kTimeIsUp;
    const bool has_ended = child.HasEnded();  // what it sent before is in the pipe
    pollfd pipe = {.fd = descriptor, .events = POLLIN, .revents = 0};
    const int ready =
        poll(&pipe, 1, has_ended ? 0 : static_cast<int>(std::min(left, kLook).count()));
    if (ready <= 0) {
      if (has_ended) return Received::kAll;
      continue;
    }
    const ssize_t got = read(descriptor, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return Received::kAll;
    bytes.append(piece.data(), static_cast<std::size_t>(got));
  }
  return Received::kTooMuch;
}

absl::Status TimeIsUp(const std::string& name, const CallLimits& limits) {
  return absl::DeadlineExceededError(
      absl::StrCat(name, " took more than ", NumberText(ToSeconds(limits.max_time)), " s"));
}

absl::Status Crashed(const std::string& name, const CallLimits& limits, std::optional<int> signal) {
  if (!signal) return absl::AbortedError(absl::StrCat(name, " crashed"));
  if (*signal == SIGXCPU) return TimeIsUp(name, limits);
  if (*signal != SIGKILL) {
    return absl::AbortedError(absl::StrCat(name, " crashed (signal ", *signal, ")"));
  }
  return absl::ResourceExhaustedError(
      absl::StrCat(name, " was killed, probably as memory ran out"));
}

// What the child sent may be anything, if it went astray. The bytes become the result.
absl::StatusOr<std::string> Decode(const std::string& name, const CallLimits& limits,
                                   std::string& bytes, std::optional<int> signal) {
  GuardedReply reply;
  if (bytes.size() < sizeof reply) return Crashed(name, limits, signal);
  std::memcpy(&reply, bytes.data(), sizeof reply);
  if (bytes.size() - sizeof reply != reply.bytes) return Crashed(name, limits, signal);
  bytes.erase(0, sizeof reply);
  if (reply.kind == 0) return std::move(bytes);
  if (reply.kind == kReplyNoMemory) {
    return absl::ResourceExhaustedError(
        absl::StrCat(name, " takes more memory than there is, or than the limit of ",
                     limits.max_memory_bytes / 1'000'000, " MB"));
  }
  if (reply.kind == kReplyThrew) return absl::AbortedError(absl::StrCat(name, ": ", bytes));
  if (reply.kind > static_cast<std::uint64_t>(absl::StatusCode::kUnauthenticated)) {
    return Crashed(name, limits, signal);
  }
  return absl::Status(static_cast<absl::StatusCode>(reply.kind), bytes);
}

// Signals are blocked meanwhile, so that no handler of this process runs in the child.
pid_t Fork(int descriptor, const CallLimits& limits,
           const std::function<absl::StatusOr<std::string>()>& function) {
  const pid_t parent = getpid();
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = fork();
  if (child == 0) RunGuardedChild(descriptor, parent, limits, function);
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return child;
}

}  // namespace

absl::StatusOr<std::string> CallGuarded(
    const std::string& name, const CallLimits& limits,
    const std::function<absl::StatusOr<std::string>()>& function) {
  const auto unavailable = [&name] {
    return absl::UnavailableError(absl::StrCat(name, " cannot be started in a process of its own: ",
                                               std::generic_category().message(errno)));
  };
  std::array<int, 2> ends = {-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return unavailable();
  Descriptor from_child, to_parent;
  from_child.number = ends[0];
  to_parent.number = ends[1];
  const Clock::time_point end = Clock::now() + std::min(limits.max_time, kLongest);
  const pid_t id = Fork(to_parent.number, limits, function);
  if (id < 0) return unavailable();
  Child child(id);
  to_parent.Close();
  std::string bytes;
  const Received received = Receive(from_child.number, end, limits.max_result_bytes, child, bytes);
  child.End();
  if (received == Received::kTimeIsUp) return TimeIsUp(name, limits);
  if (received == Received::kTooMuch) {
    return absl::ResourceExhaustedError(
        absl::StrCat(name, " returns more than ", limits.max_result_bytes, " bytes, the limit"));
  }
  return Decode(name, limits, bytes, child.signal());
}

}  // namespace clearway
