// A TCP relay on loopback, to cut connections in a test.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace clearway::testing_support {

// Carries bytes between its clients and a server at "127.0.0.1:port", in a thread of its own. Any
// thread may call any method.
class TcpRelay {
 public:
  explicit TcpRelay(const std::string& server_address)
      : server_port_(static_cast<std::uint16_t>(
            std::stoi(server_address.substr(server_address.rfind(':') + 1)))) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = Loopback(0);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(listener_, 64), 0);
    socklen_t size = sizeof address;
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { Run(); });
  }
  ~TcpRelay() {
    stop_ = true;
    thread_.join();
    for (const auto& [client, server] : pairs_) Close(client, server);
    close(listener_);
  }
  TcpRelay(const TcpRelay&) = delete;
  TcpRelay& operator=(const TcpRelay&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  // The network vanishes: connections stay open on both sides, and no byte passes any more.
  void Freeze() { frozen_ = true; }
  void Thaw() { frozen_ = false; }
  // Closes the connections there are; new ones are carried.
  void Drop() { drop_ = true; }

 private:
  using Pair = std::pair<int, int>;  // client, server

  static sockaddr_in Loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  static void Close(int client, int server) {
    close(client);
    close(server);
  }
  void Accept() {
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = Loopback(server_port_);
    if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
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

  const std::uint16_t server_port_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<bool> stop_ = false, frozen_ = false, drop_ = false;
  std::vector<Pair> pairs_;  // the thread's own
  std::thread thread_;
};

}  // namespace clearway::testing_support
