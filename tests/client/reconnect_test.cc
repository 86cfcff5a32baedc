// Mirrors, senders and watches over connections that break and servers that restart.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "client/lost_server.h"
#include "support/eventually.h"
#include "support/relay.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing_support::Eventually;
using testing_support::kPatience;
using testing_support::Numbered;
using testing_support::Quickly;
using testing_support::ReconnectTest;
using testing_support::Relay;
using testing_support::UnknownIsFree;
using testing_support::Waiting;

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
