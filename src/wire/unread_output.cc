#include "wire/unread_output.h"

#include <fcntl.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "absl/strings/numbers.h"

namespace clearway {
namespace {

constexpr Duration kLongestInterval = std::chrono::seconds(1);
constexpr Duration kShortestInterval = std::chrono::milliseconds(10);
constexpr int kLooks = 8;  // within the patience

std::vector<int> OpenFiles() {
  std::vector<int> files;
  std::error_code error;
  for (std::filesystem::directory_iterator it("/proc/self/fd", error), end; !error && it != end;
       it.increment(error)) {
    int file = -1;
    if (absl::SimpleAtoi(it->path().filename().native(), &file)) files.push_back(file);
  }
  return files;
}

// A descriptor of our own for what another thread may close meanwhile.
class Duplicate {
 public:
  explicit Duplicate(int file) : file_(fcntl(file, F_DUPFD_CLOEXEC, 0)) {}
  ~Duplicate() {
    if (file_ >= 0) close(file_);
  }
  Duplicate(const Duplicate&) = delete;
  Duplicate& operator=(const Duplicate&) = delete;
  int get() const { return file_; }

 private:
  const int file_;
};

// The path of one of a socket's ends; empty if it has none or is no Unix socket.
template <class GetName>
std::string PathOf(int socket, GetName&& get_name) {
  sockaddr_un address{};
  socklen_t size = sizeof address - 1;  // so that a zero byte always follows
  if (get_name(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return "";
  return address.sun_family == AF_UNIX ? std::string(address.sun_path) : std::string();
}

}  // namespace

UnreadOutput::UnreadOutput(std::string path, End end, Duration patience)
    : path_(std::move(path)), end_(end), patience_(patience), thread_([this] { Run(); }) {}

UnreadOutput::~UnreadOutput() {
  {
    std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void UnreadOutput::SetPatience(Duration patience) {
  {
    std::lock_guard lock(mutex_);
    patience_ = patience;
  }
  changed_.notify_all();
}

void UnreadOutput::Run() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const Duration patience = patience_;
    lock.unlock();
    Look(Clock::now(), patience);
    lock.lock();
    changed_.wait_for(lock, std::clamp(patience / kLooks, kShortestInterval, kLongestInterval),
                      [&] { return stop_ || patience_ != patience; });
  }
}

void UnreadOutput::Look(Clock::time_point now, Duration patience) {
  std::map<Name, Unread> unread;
  for (const int file : OpenFiles()) {
    const Duplicate socket(file);
    struct stat info {};
    int bytes = 0;
    if (fstat(socket.get(), &info) != 0 || !S_ISSOCK(info.st_mode) || !IsOurs(socket.get()) ||
        ioctl(socket.get(), SIOCOUTQ, &bytes) != 0 || bytes == 0) {
      continue;
    }
    const Name name(file, info.st_ino);
    const auto before = unread_.find(name);
    const bool same = before != unread_.end() && before->second.bytes == bytes;
    const Unread seen{bytes, same ? before->second.since : now};
    if (now - seen.since >= patience) {
      shutdown(socket.get(), SHUT_RDWR);
    } else {
      unread[name] = seen;
    }
  }
  unread_ = std::move(unread);
}

// A listening socket has no peer.
bool UnreadOutput::IsOurs(int socket) const {
  if (end_ == End::kClient) return PathOf(socket, getpeername) == path_;
  sockaddr_un peer{};
  socklen_t size = sizeof peer;
  return PathOf(socket, getsockname) == path_ &&
         getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &size) == 0;
}

std::string BoundPath(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int client = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  std::string bound;
  if (connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    bound = PathOf(client, getpeername);
  }
  close(client);
  return bound.empty() ? path : bound;
}

}  // namespace clearway
