// Peers that vanish or stop without a word, and the places that they still hold.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "clearway/client/scene_client.h"
#include "client/lost_server.h"
#include "support/eventually.h"
#include "support/relay.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using std::chrono::seconds;
using testing_support::Eventually;
using testing_support::kPatience;
using testing_support::Numbered;
using testing_support::Patient;
using testing_support::QuickKeepalive;
using testing_support::Quickly;
using testing_support::Relay;
using testing_support::ScatteredFrame;
using testing_support::UnknownIsFree;
using testing_support::Waiting;

using SilentPeers = testing_support::ReconnectTest;

TEST_F(SilentPeers, StreamsOfAVanishedNetworkAreFreedAndComeBack) {
  Start("127.0.0.1:0", QuickKeepalive());
  Relay relay(server_->address());
  ConnectionOptions options = Patient();
  options.keepalive_time = seconds(1);
  options.keepalive_timeout = seconds(3);
  const auto connection = Connect(relay.address(), options);
  const auto mirror = Follow(connection);
  FrameSender sender(connection);
  ASSERT_TRUE(sender.OpenStream(Collect(), AckLevel::kApplied, Quickly()).ok());
  const auto planner = RemotePlanner::For(connection, Robot::SingleShape("ball", Sphere{0.2}));
  ASSERT_TRUE(planner.ok()) << planner.status();
  std::atomic<int> told = 0, losses = 0;
  std::atomic<bool> enough = false;
  std::thread watcher([&] {
    const auto status = (*planner)->Watch(
        Waiting(), UnknownIsFree(),
        [&](const RemotePlanner::News& news) {
          ++(news.connection.ok() ? told : losses);
          return !enough;
        },
        Quickly());
    EXPECT_TRUE(status.ok()) << status;
  });
  ASSERT_TRUE(Eventually([&] { return Streams() == 3 && told > 0; }));
  relay.Freeze();
  EXPECT_TRUE(Eventually([&] { return Streams() == 0; }));
  EXPECT_TRUE(Eventually([&] { return losses > 0 && !mirror->state().connected; }));
  const int told_before = told;
  relay.Thaw();
  EXPECT_TRUE(Eventually([&] {
    return Streams() == 3 && told > told_before && mirror->state().connected &&
           sender.state().connected;
  }));
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(sender.Send(Numbered(i)).ok());
  EXPECT_TRUE(sender.CloseStream().ok());
  ExpectAnswered(1, 3);
  enough = true;
  // A change of what the watch sees ends it.
  GivenObject post;
  post.id = 1;
  post.shape = Sphere{1};
  post.pose = {server_->Newest()->stamp, Pose::Translation(0, 0, 1)};
  EXPECT_TRUE(SceneClient(Connect()).AddObjects(std::span(&post, 1)).ok());
  watcher.join();
}

// A Unix socket has no timeout for bytes that its peer does not take, and pings wait behind them.
TEST_F(SilentPeers, StreamsOfAPeerThatReadsNothingFromAUnixSocketAreFreed) {
  const TemporaryFolder folder;
  Start("unix:" + (folder / "socket").string(), QuickKeepalive());
  Relay relay(server_->address());
  const auto mirror = Follow(Connect(relay.address()));
  ASSERT_TRUE(Eventually([&] { return Streams() == 1; }));
  relay.Freeze();
  FrameSender sender(Connect());
  std::uint64_t sequence = 0;
  EXPECT_TRUE(Eventually([&] {
    EXPECT_TRUE(sender.Push(ScatteredFrame(++sequence)).ok());
    return Streams() == 0;
  }));
  relay.Thaw();
  EXPECT_TRUE(Eventually([&] { return mirror->state().reconnects == 1; }));
  EXPECT_TRUE(mirror->WaitFor(sequence + 1, kPatience).ok());
}

TEST_F(SilentPeers, ASenderNoticesAServerThatReadsNothingFromAUnixSocket) {
  const TemporaryFolder folder;
  Start("unix:" + (folder / "socket").string());
  Relay relay(server_->address());
  ConnectionOptions options = Patient();
  options.keepalive_time = seconds(1);
  options.keepalive_timeout = seconds(3);
  FrameSender dut(Connect(relay.address(), options));
  ASSERT_TRUE(dut.OpenStream(Collect(), AckLevel::kApplied, Quickly()).ok());
  ASSERT_TRUE(Eventually([&] { return dut.state().connected; }));
  relay.Freeze();
  for (std::uint64_t i = 1; i <= 5; ++i) ASSERT_TRUE(dut.Send(ScatteredFrame(i)).ok());
  EXPECT_TRUE(Eventually([&] { return !dut.state().connected; }));
  relay.Thaw();
  EXPECT_TRUE(dut.CloseStream().ok());
  ExpectAnswered(1, 5);
  EXPECT_EQ(server_->Newest()->version, 6u);
}

TEST_F(SilentPeers, AServerOnAUnixSocketEndsThoughAPeerReadsNothing) {
  const TemporaryFolder folder;
  Start("unix:" + (folder / "socket").string());
  Relay relay(server_->address());
  const auto mirror = Follow(Connect(relay.address()));
  relay.Freeze();
  FrameSender sender(Connect());
  for (std::uint64_t i = 1; i <= 10; ++i) ASSERT_TRUE(sender.Push(ScatteredFrame(i)).ok());
  server_.reset();
  relay.Thaw();
  EXPECT_TRUE(Eventually([&] { return !mirror->state().connected; }));
}

// The server still counts the connection that the client has given up.
TEST_F(SilentPeers, StreamsComeBackOnceTheirOldPlacesAreFree) {
  StartForOne();
  Relay relay(server_->address());
  const auto connection = Connect(relay.address());
  const auto mirror = Follow(connection);
  FrameSender sender(connection);
  ASSERT_TRUE(sender.OpenStream(Collect(), AckLevel::kApplied, Quickly()).ok());
  const auto planner = RemotePlanner::For(connection, Robot::SingleShape("ball", Sphere{0.2}));
  ASSERT_TRUE(planner.ok()) << planner.status();
  std::atomic<int> told = 0;
  std::thread watcher([&] {
    const auto status = (*planner)->Watch(
        Waiting(), UnknownIsFree(), [&](const RemotePlanner::News&) { return ++told < 3; },
        Quickly());
    EXPECT_TRUE(status.ok()) << status;
  });
  ASSERT_TRUE(Eventually([&] { return Streams() == 3 && told == 1; }));
  relay.DropClients();
  EXPECT_TRUE(Eventually([&] {
    return absl::IsResourceExhausted(mirror->state().last_error) &&
           absl::IsResourceExhausted(sender.state().last_error) && told == 2;
  }));
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(sender.Send(Numbered(i)).ok());
  relay.Release();
  watcher.join();
  EXPECT_TRUE(Eventually([&] { return mirror->state().connected && sender.state().connected; }));
  EXPECT_EQ(mirror->stats().full_syncs, 1u);
  EXPECT_TRUE(sender.CloseStream().ok());
  ExpectAnswered(1, 3);
}

TEST_F(SilentPeers, ASenderThatFindsNoPlaceEndsAndSaysWhy) {
  StartForOne();
  FrameSender first(Connect()), dut(Connect());
  ASSERT_TRUE(first.OpenStream(Collect()).ok());
  ASSERT_TRUE(Eventually([&] { return first.state().connected; }));
  ASSERT_TRUE(dut.OpenStream(Collect()).ok());
  absl::Status sent;
  EXPECT_TRUE(Eventually([&] {
    sent = dut.Send(Numbered(1));
    return !sent.ok();
  }));
  EXPECT_NE(sent.message().find("too many push streams at once; the limit is 1"), std::string::npos)
      << sent;
  EXPECT_TRUE(absl::IsResourceExhausted(dut.CloseStream()));
}

}  // namespace
}  // namespace clearway
