#include "server/acceptor.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "spdlog/spdlog.h"

namespace clearway {
namespace {

constexpr int kSpareDescriptors = 64;  // for files, and for what gRPC opens beside connections
constexpr std::chrono::milliseconds kPause(50);  // after descriptors have run out

std::uint64_t InodeOf(int fd) {
  struct stat status {};
  return fstat(fd, &status) == 0 && S_ISSOCK(status.st_mode) ? status.st_ino : 0;
}

// Asked each time, as it may be changed from outside.
std::uint64_t DescriptorLimit() {
  rlimit limit{};
  return getrlimit(RLIMIT_NOFILE, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

}  // namespace

Acceptor::Acceptor(std::vector<Descriptor> listeners, std::unique_ptr<Handler> handler,
                   std::uint64_t max_connections)
    : listeners_(std::move(listeners)),
      handler_(std::move(handler)),
      max_connections_(max_connections),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

Acceptor::~Acceptor() { Close(); }

void Acceptor::Start() {
  thread_ = std::thread([this] { Run(); });
}

void Acceptor::Close() {
  if (thread_.joinable()) {
    eventfd_write(stop_.get(), 1);
    thread_.join();
  }
  listeners_.clear();
}

void Acceptor::Run() {
  std::vector<pollfd> polled{{stop_.get(), POLLIN, 0}};
  for (const Descriptor& listener : listeners_) polled.push_back({listener.get(), POLLIN, 0});
  while (true) {
    if (poll(polled.data(), polled.size(), -1) < 0) continue;  // a signal
    if (polled.front().revents != 0) return;
    for (std::size_t i = 1; i < polled.size(); ++i) {
      if (polled[i].revents == 0 || TakeFrom(polled[i].fd)) continue;
      poll(polled.data(), 1, static_cast<int>(kPause.count()));
    }
  }
}

bool Acceptor::TakeFrom(int listener) {
  Descriptor connection(accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!connection.ok()) {
    const int error = errno;
    if (error == EAGAIN || error == EINTR || error == ECONNABORTED) return true;
    spdlog::warn("a connection waits: {}", std::strerror(error));
    return false;
  }
  if (!HasRoomFor(connection.get())) {
    spdlog::warn(
        "a connection is refused: there are too many (limits.max_connections is {}, "
        "descriptors {})",
        max_connections_, DescriptorLimit());
    return true;
  }
  connections_.emplace_back(connection.get(), InodeOf(connection.get()));
  Handler::NewConnectionParameters parameters;
  parameters.listener_fd = listener;
  parameters.fd = connection.Release();  // gRPC closes it
  handler_->HandleNewConnection(&parameters);
  return true;
}

// The system gives out the lowest number that is free, so a high one tells that many are in use.
bool Acceptor::HasRoomFor(int fd) {
  if (static_cast<std::uint64_t>(fd) + kSpareDescriptors >= DescriptorLimit()) return false;
  if (connections_.size() < max_connections_) return true;
  std::erase_if(connections_, [&](const Connection& connection) {
    return connection.first == fd || InodeOf(connection.first) != connection.second;
  });
  return connections_.size() < max_connections_;
}

void RaiseDescriptorLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace clearway
