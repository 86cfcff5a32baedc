#include "wire/unread_output.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>

#include "support/eventually.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using testing_support::Eventually;

// Two ends of a connection at a path. One thread.
class Ends {
 public:
  explicit Ends(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    client_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    EXPECT_EQ(connect(client_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    server_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  }
  ~Ends() {
    for (const int end : {listener_, client_, server_}) close(end);
  }
  Ends(const Ends&) = delete;
  Ends& operator=(const Ends&) = delete;

  int client() const { return client_; }
  int server() const { return server_; }
  static void Write(int end) { EXPECT_EQ(send(end, "four", 4, MSG_NOSIGNAL), 4); }
  static void Read(int end) {
    std::array<char, 4> bytes;
    EXPECT_EQ(recv(end, bytes.data(), bytes.size(), 0), 4);
  }
  static bool IsShutDown(int end) {
    pollfd polled{end, POLLOUT, 0};
    return poll(&polled, 1, 0) == 1 && (polled.revents & POLLHUP) != 0;
  }

 private:
  int listener_, client_, server_;
};

TEST(UnreadOutput, Empty) {
  const TemporaryFolder folder;
  const UnreadOutput dut(folder / "nowhere", UnreadOutput::End::kServer, milliseconds(10));
}

TEST(UnreadOutput, WhatNobodyReadsIsShutDownAtTheEndThatIsWatched) {
  const TemporaryFolder folder;
  const std::string path = folder / "socket", other = folder / "other";
  for (const auto side : {UnreadOutput::End::kServer, UnreadOutput::End::kClient}) {
    std::filesystem::remove(path);
    std::filesystem::remove(other);
    const Ends ends(path), elsewhere(other);
    const bool server = side == UnreadOutput::End::kServer;
    const int ours = server ? ends.server() : ends.client();
    Ends::Write(ours);
    Ends::Write(elsewhere.server());
    Ends::Write(elsewhere.client());
    const UnreadOutput dut(path, side, milliseconds(50));
    EXPECT_TRUE(Eventually([&] { return Ends::IsShutDown(ours); }));
    EXPECT_FALSE(Ends::IsShutDown(elsewhere.server()));
    EXPECT_FALSE(Ends::IsShutDown(elsewhere.client()));
  }
}

TEST(UnreadOutput, WhoReadsIsLeftAlone) {
  const TemporaryFolder folder;
  const std::string path = folder / "socket";
  const Ends ends(path);
  const UnreadOutput dut(path, UnreadOutput::End::kServer, std::chrono::hours(1));
  for (int i = 0; i < 20; ++i) {
    Ends::Write(ends.server());
    std::this_thread::sleep_for(milliseconds(5));
    Ends::Read(ends.client());
  }
  EXPECT_FALSE(Ends::IsShutDown(ends.server()));
}

TEST(UnreadOutput, PatienceMayEnd) {
  const TemporaryFolder folder;
  const std::string path = folder / "socket";
  const Ends ends(path);
  Ends::Write(ends.server());
  UnreadOutput dut(path, UnreadOutput::End::kServer, std::chrono::hours(1));
  dut.SetPatience(milliseconds(10));
  EXPECT_TRUE(Eventually([&] { return Ends::IsShutDown(ends.server()); }));
}

TEST(UnreadOutput, APathIsKnownAsItWasBound) {
  const TemporaryFolder folder;
  const std::string path = folder / "socket", link = folder / "link";
  std::filesystem::create_symlink(path, link);
  EXPECT_EQ(BoundPath(link), link);  // nobody listens
  const Ends ends(path);
  EXPECT_EQ(BoundPath(link), path);
}

}  // namespace
}  // namespace clearway
