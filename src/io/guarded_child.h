// The child process of a guarded call.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>

#include "io/guarded_call.h"

namespace clearway {

// What the child sends first: how the call ended, and the size of the bytes that follow, which are
// its result or a message.
struct GuardedReply {
  std::uint64_t kind = 0;  // an absl::StatusCode, or one of those below
  std::uint64_t bytes = 0;
};
constexpr std::uint64_t kReplyNoMemory = 100, kReplyThrew = 101;

// Calls `function` within the limits of memory and time, sends what it returns to the descriptor,
// and exits. To be called in a new child, with all signals blocked; `parent` is the process that
// forked.
[[noreturn]] void RunGuardedChild(
    int descriptor, pid_t parent, const CallLimits& limits,
    const std::function<absl::StatusOr<std::string>()>& function) noexcept;

}  // namespace clearway
