// Mirrors, senders and watches over connections that break and servers that restart.
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "clearway/client/frame_sender.h"
#include "clearway/client/remote_planner.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "support/eventually.h"
#include "support/frames.h"
#include "support/relay.h"
#include "support/temporary_folder.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::Eventually;
using testing_support::Relay;
using testing_support::ScatteredFrame;
using testing_support::TestServer;

constexpr Duration kPatience = seconds(60);

// Dead peers are found in seconds.
KeepaliveConfig QuickKeepalive() { return {seconds(1), seconds(3), milliseconds(500)}; }

ConnectionOptions Patient() {
  ConnectionOptions options;
  options.deadline = kPatience;
  return options;
}

Frame Numbered(std::uint64_t sequence) {
  Frame frame = testing_support::FrameAt(0.1 * static_cast<double>(sequence));
  frame.sequence = sequence;
  testing_support::AddPoint(frame, kStaticLabel, {3, 0.2 * static_cast<double>(sequence), 0});
  return frame;
}

class ReconnectTest : public testing::Test {
 protected:
  ReconnectTest() { Start(); }

  void Start(const std::string& address = "127.0.0.1:0", const KeepaliveConfig& keepalive = {}) {
    ServerConfig config = testing_support::SmallConfig();
    config.listen = address;
    config.keepalive = keepalive;
    server_.emplace(config);
  }
  // Another server at the same address, with an empty scene.
  void Restart() {
    const std::string address = server_->address();
    server_.reset();
    Start(address);
  }
  std::shared_ptr<Connection> Connect(const std::string& address,
                                      const ConnectionOptions& options = Patient()) {
    auto connection = Connection::Open(address, options);
    EXPECT_TRUE(connection.ok()) << connection.status();
    return connection.value_or(nullptr);
  }
  std::shared_ptr<Connection> Connect() { return Connect(server_->address()); }

  std::unique_ptr<SceneMirror> Follow(const std::shared_ptr<Connection>& connection) {
    SceneMirrorOptions options;
    options.heartbeat = milliseconds(100);
    options.reconnect.max_pause = milliseconds(200);
    auto mirror = SceneMirror::Follow(connection, options);
    EXPECT_TRUE(mirror.ok()) << mirror.status();
    return mirror.ok() ? *std::move(mirror) : nullptr;
  }
  FrameSender::OnAck Collect() {
    return [this](const std::string&, std::uint64_t sequence, const absl::StatusOr<PushAck>& ack) {
      std::lock_guard lock(mutex_);
      EXPECT_TRUE(ack.ok()) << sequence << ": " << ack.status();
      EXPECT_TRUE(!ack.ok() || !ack->repeated_answer) << sequence;
      answered_.push_back(sequence);
    };
  }
  std::vector<std::uint64_t> answered() {
    std::lock_guard lock(mutex_);
    return answered_;
  }
  void ExpectAnswered(std::uint64_t first, std::uint64_t last) {
    std::vector<std::uint64_t> expected;
    for (std::uint64_t i = first; i <= last; ++i) expected.push_back(i);
    EXPECT_EQ(answered(), expected);
  }
  // A server with a place for one stream of each kind.
  void StartForOne() {
    ServerConfig config = testing_support::SmallConfig();
    config.limits.max_follow_streams = config.limits.max_push_streams = 1;
    config.limits.max_watch_streams = 1;
    server_.emplace(config);
  }
  // Everything that counts someone who stays connected.
  std::uint64_t Streams() {
    const ServerCore& core = server_->core();
    return core.follow_streams + core.push_streams + core.watch_streams;
  }

  std::optional<TestServer> server_;
  std::mutex mutex_;
  std::vector<std::uint64_t> answered_;
};

ReconnectOptions Quickly() {
  ReconnectOptions options;
  options.max_pause = milliseconds(200);
  return options;
}

// A robot at rest above the origin for a second.
MotionBatch Waiting() {
  MotionBatch motions;
  motions.knot_counts = {2};
  motions.times = {Time() + seconds(100), Time() + seconds(101)};
  motions.T_W_L = {Pose::Translation(0, 0, 1), Pose::Translation(0, 0, 1)};
  motions.deviations_m = {0, 0};
  return motions;
}

MotionOptions UnknownIsFree() {
  MotionOptions options;
  options.check.unknown = UnknownPolicy::kFree;
  return options;
}

TEST_F(ReconnectTest, AMirrorFollowsARestartedServer) {
  const auto dut = Follow(Connect());
  FrameSender first(Connect());
  ASSERT_TRUE(first.Push(Numbered(1)).ok());
  ASSERT_TRUE(dut->WaitFor(2, kPatience).ok());
  EXPECT_TRUE(dut->state().connected);
  EXPECT_EQ(dut->state().reconnects, 0u);
  const std::string address = server_->address();
  server_.reset();
  ASSERT_TRUE(Eventually([&] { return !dut->state().connected; }));
  EXPECT_TRUE(absl::IsUnavailable(dut->state().last_error)) << dut->state().last_error;
  EXPECT_EQ(dut->Latest()->version, 2u);  // stale, as version and stamp tell
  // The old server's versions mean nothing to a new one.
  EXPECT_TRUE(absl::IsDeadlineExceeded(dut->WaitFor(2, milliseconds(50)).status()));
  Start(address);
  ASSERT_TRUE(Eventually([&] { return dut->state().connected; }));
  EXPECT_EQ(dut->state().reconnects, 1u);
  EXPECT_EQ(dut->state().server_restarts, 1u);
  EXPECT_EQ(dut->Latest()->Hash(), server_->Newest()->Hash());
  EXPECT_EQ(dut->Latest()->version, 1u);
  EXPECT_EQ(dut->stats().full_syncs, 2u);
}

TEST_F(ReconnectTest, AMirrorGoesOnFromItsVersionWhenOnlyTheConnectionBroke) {
  Relay relay(server_->address());
  const auto dut = Follow(Connect(relay.address()));
  FrameSender sender(Connect());
  ASSERT_TRUE(sender.Push(Numbered(1)).ok());
  ASSERT_TRUE(dut->WaitFor(2, kPatience).ok());
  relay.Drop();
  ASSERT_TRUE(Eventually([&] { return dut->state().reconnects == 1; }));
  ASSERT_TRUE(sender.Push(Numbered(2)).ok());
  ASSERT_TRUE(dut->WaitFor(3, kPatience).ok());
  EXPECT_EQ(dut->Latest()->Hash(), server_->Newest()->Hash());
  EXPECT_EQ(dut->stats().full_syncs, 1u);
  EXPECT_EQ(dut->state().server_restarts, 0u);
}

TEST_F(ReconnectTest, AStaleMirrorIsRefusedWhereFreshnessIsAskedFor) {
  Relay relay(server_->address());
  const auto dut = Follow(Connect(relay.address()));
  const Duration max_age = seconds(2);
  // An idle server's heartbeats keep it fresh.
  ASSERT_TRUE(Eventually([&] { return dut->Latest(milliseconds(500)).ok(); }));
  relay.Freeze();
  ASSERT_TRUE(Eventually([&] { return !dut->Latest(max_age).ok(); }));
  const absl::Status stale = dut->Latest(max_age).status();
  EXPECT_TRUE(absl::IsUnavailable(stale));
  EXPECT_NE(stale.message().find("the limit is 2 s"), std::string::npos) << stale;
  EXPECT_NE(dut->Latest(), nullptr);
  relay.Thaw();
  EXPECT_TRUE(Eventually([&] { return dut->Latest(max_age).ok(); }));
}

TEST_F(ReconnectTest, StreamsOfAVanishedNetworkAreFreedAndComeBack) {
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
TEST_F(ReconnectTest, StreamsOfAPeerThatReadsNothingFromAUnixSocketAreFreed) {
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

TEST_F(ReconnectTest, ASenderNoticesAServerThatReadsNothingFromAUnixSocket) {
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

TEST_F(ReconnectTest, AServerOnAUnixSocketEndsThoughAPeerReadsNothing) {
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
TEST_F(ReconnectTest, StreamsComeBackOnceTheirOldPlacesAreFree) {
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

TEST_F(ReconnectTest, ASenderThatFindsNoPlaceEndsAndSaysWhy) {
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

TEST_F(ReconnectTest, ASenderSendsAgainWhatWasNotAnswered) {
  Relay relay(server_->address());
  FrameSender dut(Connect(relay.address()));
  ASSERT_TRUE(dut.OpenStream(Collect(), AckLevel::kApplied, Quickly()).ok());
  for (std::uint64_t i = 1; i <= 60; ++i) {
    if (i % 10 == 5) relay.Drop();
    ASSERT_TRUE(dut.Send(Numbered(i)).ok());
  }
  const absl::Status closed = dut.CloseStream();
  EXPECT_TRUE(closed.ok()) << closed;
  ExpectAnswered(1, 60);
  EXPECT_EQ(server_->Newest()->version, 61u);  // each was applied once
}

TEST_F(ReconnectTest, ASenderGoesOnWithARestartedServer) {
  FrameSender dut(Connect());
  std::vector<bool> changes;
  ReconnectOptions reconnect = Quickly();
  reconnect.on_change = [&](const StreamState& state) {
    std::lock_guard lock(mutex_);
    changes.push_back(state.connected);
  };
  ASSERT_TRUE(dut.OpenStream(Collect(), AckLevel::kApplied, reconnect).ok());
  ASSERT_TRUE(Eventually([&] { return dut.state().connected; }));
  for (std::uint64_t i = 1; i <= 5; ++i) ASSERT_TRUE(dut.Send(Numbered(i)).ok());
  ASSERT_TRUE(Eventually([&] { return dut.unanswered() == 0; }));
  Restart();
  for (std::uint64_t i = 6; i <= 20; ++i) ASSERT_TRUE(dut.Send(Numbered(i)).ok());
  ASSERT_TRUE(Eventually([&] { return dut.unanswered() == 0; }));
  EXPECT_EQ(dut.state().reconnects, 1u);
  EXPECT_FALSE(dut.state().last_error.ok());
  EXPECT_TRUE(dut.CloseStream().ok());
  ExpectAnswered(1, 20);
  EXPECT_EQ(server_->Newest()->version, 16u);
  EXPECT_EQ(changes, (std::vector<bool>{true, false, true}));
}

// A server that drains refuses frame by frame; these are not lost.
TEST_F(ReconnectTest, FramesThatADrainingServerRefusesGoToTheNext) {
  FrameSender dut(Connect());
  ASSERT_TRUE(dut.OpenStream(Collect(), AckLevel::kApplied, Quickly()).ok());
  ASSERT_TRUE(dut.Send(Numbered(1)).ok());
  ASSERT_TRUE(Eventually([&] { return dut.unanswered() == 0; }));
  server_->core().draining = true;
  ASSERT_TRUE(dut.Send(Numbered(2)).ok());
  ASSERT_TRUE(dut.Send(Numbered(3)).ok());
  ASSERT_TRUE(Eventually([&] { return !dut.state().last_error.ok(); }));
  EXPECT_EQ(dut.unanswered(), 2u);
  Restart();
  EXPECT_TRUE(dut.CloseStream().ok());
  ExpectAnswered(1, 3);
}

TEST_F(ReconnectTest, ASenderGivesUpWhenToldTo) {
  FrameSender dut(Connect());
  ReconnectOptions reconnect = Quickly();
  reconnect.give_up_after = milliseconds(300);
  ASSERT_TRUE(dut.OpenStream(Collect(), AckLevel::kApplied, reconnect).ok());
  server_.reset();
  absl::Status sent;
  for (std::uint64_t i = 1; sent.ok() && i < 1000; ++i) sent = dut.Send(Numbered(i));
  EXPECT_TRUE(absl::IsUnavailable(sent)) << sent;
  EXPECT_TRUE(absl::IsUnavailable(dut.CloseStream()));
}

TEST_F(ReconnectTest, ASenderWithoutAServerCanBeAbandoned) {
  FrameSender dut(Connect());
  ASSERT_TRUE(dut.OpenStream(Collect()).ok());
  server_.reset();
  ASSERT_TRUE(dut.Send(Numbered(1)).ok()) << dut.CloseStream();
}

TEST_F(ReconnectTest, AWatchKnowsNothingWhileTheServerIsAwayAndRegistersItsRobotAgain) {
  const auto planner = RemotePlanner::For(Connect(), Robot::SingleShape("ball", Sphere{0.2}));
  ASSERT_TRUE(planner.ok()) << planner.status();
  std::vector<RemotePlanner::News> news;
  std::atomic<std::size_t> told = 0;
  std::thread watcher([&] {
    const auto status = (*planner)->Watch(
        Waiting(), UnknownIsFree(),
        [&](const RemotePlanner::News& n) {
          news.push_back(n);
          return ++told < 3;
        },
        Quickly());
    EXPECT_TRUE(status.ok()) << status;
  });
  ASSERT_TRUE(Eventually([&] { return told == 1; }));
  Restart();
  watcher.join();
  ASSERT_EQ(news.size(), 3u);
  EXPECT_TRUE(news[0].connection.ok());
  EXPECT_EQ(news[0].reply.answers[0].status, SpaceStatus::kFree);
  EXPECT_TRUE(absl::IsUnavailable(news[1].connection)) << news[1].connection;
  EXPECT_EQ(news[1].reply.answers[0].status, SpaceStatus::kUnresolved);
  EXPECT_EQ(news[1].broken, std::vector<std::size_t>{0});
  EXPECT_TRUE(news[2].connection.ok());
  EXPECT_EQ(news[2].mended, std::vector<std::size_t>{0});
}

TEST_F(ReconnectTest, AWatchGivesUpWhenToldTo) {
  const auto planner = RemotePlanner::For(Connect(), Robot::SingleShape("ball", Sphere{0.2}));
  ASSERT_TRUE(planner.ok()) << planner.status();
  server_.reset();
  ReconnectOptions reconnect = Quickly();
  reconnect.give_up_after = milliseconds(300);
  int losses = 0;
  const auto status = (*planner)->Watch(
      Waiting(), UnknownIsFree(),
      [&](const RemotePlanner::News& news) {
        EXPECT_FALSE(news.connection.ok());
        ++losses;
        return true;
      },
      reconnect);
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_EQ(losses, 1);
}

}  // namespace
}  // namespace clearway
