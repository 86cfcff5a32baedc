// Connections to the program itself: too many, and no descriptors for more.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/client/scene_client.h"
#include "server/descriptor.h"
#include "server/process.h"
#include "support/eventually.h"

namespace clearway {
namespace {

using testing_support::Eventually;
using testing_support::Process;

class Connections : public testing::Test {
 protected:
  void Start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> flags{"--listen", "127.0.0.1:0"};
    flags.insert(flags.end(), more.begin(), more.end());
    dut_ = std::make_unique<Process>(flags);
    address_ = dut_->Address();
    ASSERT_FALSE(address_.empty());
  }
  // Connections that say nothing.
  std::vector<Descriptor> OpenSilent(int count) const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int port = std::stoi(address_.substr(address_.rfind(':') + 1));
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    std::vector<Descriptor> opened;
    for (int i = 0; i < count; ++i) {
      opened.emplace_back(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
      EXPECT_EQ(
          connect(opened.back().get(), reinterpret_cast<const sockaddr*>(&address), sizeof address),
          0);
    }
    return opened;
  }
  bool Connects(std::chrono::milliseconds patience) const {
    ConnectionOptions options;
    options.deadline = options.retry_for = patience;
    return Connection::Open(address_, options).ok();
  }
  void AllowDescriptors(rlim_t count) const {
    const rlimit limit{count, before_.rlim_max};
    ASSERT_EQ(prlimit(dut_->id(), RLIMIT_NOFILE, &limit, nullptr), 0);
  }
  int Descriptors() const {
    const std::filesystem::directory_iterator files(absl::StrCat("/proc/", dut_->id(), "/fd"));
    return static_cast<int>(std::distance(begin(files), end(files)));
  }
  void RememberLimit() { ASSERT_EQ(prlimit(dut_->id(), RLIMIT_NOFILE, nullptr, &before_), 0); }

  rlimit before_{};
  std::unique_ptr<Process> dut_;
  std::string address_;
};

TEST_F(Connections, AsManyAsAllowedAndNoMore) {
  Start({"--limits-max-connections", "8"});
  for (int round = 0; round < 3; ++round) {
    auto silent = OpenSilent(20);
    EXPECT_TRUE(Eventually([&] { return !Connects(std::chrono::milliseconds(200)); }));
    silent.clear();
    EXPECT_TRUE(Connects(std::chrono::seconds(1)));
  }
  dut_->Signal(SIGTERM);
  EXPECT_EQ(dut_->Wait(), 0);
  EXPECT_THAT(dut_->RestOfOutput(), testing::HasSubstr("limits.max_connections is 8"));
}

TEST_F(Connections, ToThisMachineGoThroughNoProxy) {
  Start();
  setenv("http_proxy", "http://127.0.0.1:9", 1);  // nobody listens there
  EXPECT_TRUE(Connects(std::chrono::seconds(1)));
  unsetenv("http_proxy");
}

TEST_F(Connections, ItsLimitIsRaisedAtStart) {
  Start();
  RememberLimit();
  EXPECT_EQ(before_.rlim_cur, before_.rlim_max);
}

TEST_F(Connections, SomeDescriptorsAreKeptForOtherThings) {
  Start();
  RememberLimit();
  AllowDescriptors(200);
  for (int round = 0; round < 10; ++round) {
    auto silent = OpenSilent(300);
    EXPECT_TRUE(Eventually([&] { return !Connects(std::chrono::milliseconds(200)); }));
    EXPECT_LE(Descriptors(), 200 - 60);
    silent.clear();
    EXPECT_TRUE(Connects(std::chrono::seconds(1))) << round;
  }
}

TEST_F(Connections, WaitWhileThereAreNoDescriptorsAtAll) {
  Start();
  RememberLimit();
  for (int round = 0; round < 10; ++round) {
    AllowDescriptors(3);
    EXPECT_FALSE(Connects(std::chrono::milliseconds(150)));
    AllowDescriptors(before_.rlim_cur);
    EXPECT_TRUE(Connects(std::chrono::seconds(1))) << round;
  }
}

}  // namespace
}  // namespace clearway
