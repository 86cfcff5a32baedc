// Connections over Unix sockets whose peer reads nothing.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "clearway/base/time.h"

namespace clearway {

// Shuts down the connections of this process at one Unix socket whose peer has taken none of the
// bytes sent to it for some time, in a thread of its own. For TCP the kernel does that
// (TCP_USER_TIMEOUT, which gRPC sets); Unix sockets have no such timeout, and gRPC's pings, the end
// of its streams and its shutdown all wait behind a write that is blocked. Sockets are found in
// /proc/self/fd; without it nothing is shut down. Any thread may call any method.
class UnreadOutput {
 public:
  enum class End { kServer, kClient };  // which end of the connections is this process's

  // `path` as the server bound it.
  UnreadOutput(std::string path, End end, Duration patience);
  ~UnreadOutput();
  UnreadOutput(const UnreadOutput&) = delete;
  UnreadOutput& operator=(const UnreadOutput&) = delete;

  void SetPatience(Duration patience);

 private:
  using Clock = std::chrono::steady_clock;
  // A socket, by its number and inode: numbers are used again.
  using Name = std::pair<int, std::uint64_t>;
  struct Unread {
    int bytes = 0;
    Clock::time_point since;  // when the number was first seen
  };

  void Run();
  void Look(Clock::time_point now, Duration patience);
  bool IsOurs(int socket) const;

  const std::string path_;
  const End end_;
  std::map<Name, Unread> unread_;  // the thread's own

  std::mutex mutex_;
  std::condition_variable changed_;
  Duration patience_;
  bool stop_ = false;
  std::thread thread_;
};

// The path to which the server at a Unix socket bound it, as the kernel tells those who connect;
// `path` itself if nobody listens.
std::string BoundPath(const std::string& path);

}  // namespace clearway
