// A relay on this machine, to cut connections in a test.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace clearway::testing_support {

// Carries bytes between its clients and a server at "127.0.0.1:port" or "unix:/path", in a thread
// of its own, and listens at another port, or at "unix:/path.relay". Any thread may call any
// method.
class Relay {
 public:
  explicit Relay(const std::string& server_address)
      : unix_(server_address.starts_with("unix:")),
        server_(unix_ ? AtPath(server_address.substr(5))
                      : Loopback(std::stoi(server_address.substr(server_address.rfind(':') + 1)))) {
    listener_ = Open();
    // Little is under way, so that a frozen relay soon blocks who writes.
    const int few_bytes = 4096;
    if (!unix_) setsockopt(listener_, SOL_SOCKET, SO_RCVBUF, &few_bytes, sizeof few_bytes);
    Address own = unix_ ? AtPath(server_address.substr(5) + ".relay") : Loopback(0);
    EXPECT_EQ(bind(listener_, own.get(), own.size), 0);
    EXPECT_EQ(listen(listener_, 64), 0);
    getsockname(listener_, own.get(), &own.size);
    address_ = unix_ ? server_address + ".relay"
                     : "127.0.0.1:" + std::to_string(ntohs(own.as.internet.sin_port));
    thread_ = std::thread([this] { Run(); });
  }
  ~Relay() {
    stop_ = true;
    thread_.join();
    for (const auto& [client, server] : pairs_) Close(client, server);
    for (const int server : held_) close(server);
    close(listener_);
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  const std::string& address() const { return address_; }
  // The network vanishes: connections stay open on both sides, and no byte passes any more.
  void Freeze() { frozen_ = true; }
  void Thaw() { frozen_ = false; }
  // Closes the connections there are; new ones are carried.
  void Drop() { drop_ = true; }
  // Likewise, but the server hears nothing of it until Release.
  void DropClients() { drop_clients_ = true; }
  void Release() { release_ = true; }

 private:
  using Pair = std::pair<int, int>;  // client, server

  struct Address {
    union {
      sockaddr any;
      sockaddr_in internet;
      sockaddr_un local;
    } as{};
    socklen_t size = 0;
    sockaddr* get() { return &as.any; }
  };
  static Address Loopback(int port) {
    Address address;
    address.as.internet = {};
    address.as.internet.sin_family = AF_INET;
    address.as.internet.sin_port = htons(static_cast<std::uint16_t>(port));
    address.as.internet.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.size = sizeof address.as.internet;
    return address;
  }
  static Address AtPath(const std::string& path) {
    Address address;
    address.as.local = {};
    address.as.local.sun_family = AF_UNIX;
    path.copy(address.as.local.sun_path, sizeof address.as.local.sun_path - 1);
    address.size = sizeof address.as.local;
    return address;
  }
  int Open() const { return socket(unix_ ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); }
  static void Close(int client, int server) {
    close(client);
    close(server);
  }
  void Accept() {
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int server = Open();
    const int few_bytes = 4096;
    if (!unix_) setsockopt(server, SOL_SOCKET, SO_RCVBUF, &few_bytes, sizeof few_bytes);
    if (connect(server, server_.get(), server_.size) != 0) {
      return Close(client, server);
    }
    pairs_.push_back({client, server});
  }
  // False at the end.
  static bool Carry(int from, int to) {
    std::array<char, 65536> bytes;
    const ssize_t size = recv(from, bytes.data(), bytes.size(), 0);
    if (size <= 0) return false;
    for (ssize_t sent = 0; sent < size;) {
      const ssize_t part = send(to, bytes.data() + sent, size - sent, MSG_NOSIGNAL);
      if (part <= 0) return false;
      sent += part;
    }
    return true;
  }
  void Run() {
    while (!stop_) {
      if (drop_.exchange(false)) {
        for (const auto& [client, server] : pairs_) Close(client, server);
        pairs_.clear();
      }
      if (drop_clients_.exchange(false)) {
        for (const auto& [client, server] : pairs_) {
          close(client);
          held_.push_back(server);
        }
        pairs_.clear();
      }
      if (release_.exchange(false)) {
        for (const int server : held_) close(server);
        held_.clear();
      }
      std::vector<pollfd> polled{{listener_, POLLIN, 0}};
      for (const auto& [client, server] : pairs_) {
        polled.push_back({client, POLLIN, 0});
        polled.push_back({server, POLLIN, 0});
      }
      if (frozen_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        continue;
      }
      poll(polled.data(), polled.size(), 10);
      std::vector<Pair> open;
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const auto [client, server] = pairs_[i];
        const bool alive = (polled[2 * i + 1].revents == 0 || Carry(client, server)) &&
                           (polled[2 * i + 2].revents == 0 || Carry(server, client));
        alive ? open.push_back(pairs_[i]) : Close(client, server);
      }
      pairs_ = std::move(open);
      if (polled[0].revents != 0) Accept();
    }
  }

  const bool unix_;
  Address server_;
  std::string address_;
  int listener_ = -1;
  std::atomic<bool> stop_ = false, frozen_ = false;
  std::atomic<bool> drop_ = false, drop_clients_ = false, release_ = false;
  // The thread's own.
  std::vector<Pair> pairs_;
  std::vector<int> held_;  // to the server, without a client
  std::thread thread_;
};

}  // namespace clearway::testing_support
