#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "clearway/client/error_details.h"
#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/scene/scene_delta.h"
#include "support/frames.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::RandomFrames;
using testing_support::TestServer;

constexpr Duration kPatience = std::chrono::seconds(60);

class MirrorTest : public testing::Test {
 protected:
  std::unique_ptr<SceneMirror> Follow(const SceneMirrorOptions& options = {}) {
    auto mirror = SceneMirror::Follow(server_.Connect(), options);
    EXPECT_TRUE(mirror.ok()) << mirror.status();
    return mirror.ok() ? *std::move(mirror) : nullptr;
  }
  // The version with the last frame in it.
  std::uint64_t Push(int frames) {
    std::uint64_t version = 0;
    for (int i = 0; i < frames; ++i) {
      Frame frame = frames_.Next();
      frame.sequence = ++sequence_;
      const auto ack = sender_.Push(frame);
      EXPECT_TRUE(ack.ok()) << ack.status();
      if (ack.ok()) version = ack->version;
    }
    return version;
  }
  void ExpectEqual(const SceneMirror& dut, std::uint64_t version) {
    const auto scene = dut.WaitFor(version, kPatience);
    ASSERT_TRUE(scene.ok()) << scene.status();
    const ScenePtr truth = server_.core().versions.Find((*scene)->version);
    ASSERT_NE(truth, nullptr);
    EXPECT_EQ((*scene)->Hash(), truth->Hash());
    EXPECT_TRUE(SameContent(**scene, *truth));
  }

  static ServerConfig Config() {
    ServerConfig config = testing_support::SmallConfig();
    config.kept_versions = 1000;  // so that a test finds what the mirror shows
    return config;
  }
  TestServer server_{Config()};
  FrameSender sender_{server_.Connect()};
  RandomFrames frames_{7};
  std::uint64_t sequence_ = 0;
};

TEST_F(MirrorTest, Empty) {
  const auto dut = Follow();
  ASSERT_NE(dut, nullptr);
  EXPECT_EQ(dut->Latest()->version, 1u);
  ExpectEqual(*dut, 1);
  EXPECT_EQ(dut->stats().full_syncs, 1u);
}

TEST_F(MirrorTest, FollowsEveryVersion) {
  const auto dut = Follow();
  for (int i = 0; i < 30; ++i) ExpectEqual(*dut, Push(1));
  EXPECT_EQ(dut->stats().full_syncs, 1u);
  EXPECT_EQ(dut->state().reconnects, 0u);
}

TEST_F(MirrorTest, ComesInLate) {
  const std::uint64_t version = Push(40);
  ExpectEqual(*Follow(), version);
}

TEST_F(MirrorTest, IsEqualAfterAnySequenceOfSkips) {
  for (int interval_ms : {1, 5, 20}) {
    const auto dut = Follow({.min_interval = std::chrono::milliseconds(interval_ms)});
    ExpectEqual(*dut, Push(60));
    EXPECT_EQ(dut->stats().full_syncs, 1u);
  }
}

TEST_F(MirrorTest, OfStatesIsTheServersInEveryState) {
  const auto dut = Follow({.min_interval = std::chrono::milliseconds(2), .states_only = true});
  const auto whole = Follow();
  const std::uint64_t version = Push(60);
  const auto scene = dut->WaitFor(version, kPatience);
  ASSERT_TRUE(scene.ok()) << scene.status();
  const ScenePtr truth = server_.core().versions.Find((*scene)->version);
  const auto states = Apply(nullptr, Diff(nullptr, *truth, MapDetail::kStates));
  ASSERT_TRUE(states.ok()) << states.status();
  EXPECT_EQ((*scene)->Hash(), states->Hash());
  EXPECT_NE((*scene)->Hash(), truth->Hash());
  ExpectEqual(*whole, version);
}

TEST_F(MirrorTest, FollowsChangesByHand) {
  const auto dut = Follow();
  Push(20);
  const SceneClient client(server_.Connect());
  const Aabb box{{-2, -2, -2}, {2, 2, 2}};
  ExpectEqual(*dut, client.ClearRegion(box)->version);
  ExpectEqual(*dut, client.SetKeepOut(std::span(&box, 1))->version);
  const Time now = server_.Newest()->stamp;
  const std::vector<StampedPose> future{{now + FromSeconds(1), Pose::Translation(1, 2, 0)}};
  const GivenObject given[] = {{100, Sphere{1}, {now, Pose{}}, Twist{}, future},
                               {101, Box{{1, 2, 3}}, {now, Pose{}}, {}, {}}};
  ExpectEqual(*dut, client.AddObjects(given)->version);
  const ObjectFuture stated[] = {{100, {}}, {101, future}};
  ExpectEqual(*dut, client.SetFutures(stated)->version);
  ExpectEqual(*dut, Push(5));
  const ObjectId ids[] = {101};
  ExpectEqual(*dut, client.RemoveObjects(ids)->version);
  EXPECT_NE(dut->Latest()->FindObject(100), nullptr);
  ExpectEqual(*dut, client.Reset()->version);
  frames_ = RandomFrames(9);
  ExpectEqual(*dut, Push(10));
}

TEST_F(MirrorTest, StartsAgainFromNothingWhenTheServerNoLongerHoldsItsVersion) {
  ServerConfig config = testing_support::SmallConfig();
  config.kept_versions = 1;
  server_.Stop();
  server_ = TestServer(config);
  sender_ = FrameSender(server_.Connect());
  const auto dut = Follow();
  const std::uint64_t version = Push(50);
  const auto scene = dut->WaitFor(version, kPatience);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ((*scene)->Hash(), server_.Newest()->Hash());
}

TEST_F(MirrorTest, AnotherServerBehindTheAddressIsMirroredFromNothing) {
  ServerConfig config = Config();
  config.listen = server_.address();
  const auto dut = Follow({.reconnect = {.max_pause = std::chrono::milliseconds(100)}});
  ExpectEqual(*dut, Push(10));
  server_.Stop();
  EXPECT_NE(dut->Latest(), nullptr);  // stays what it was
  server_ = TestServer(config);       // begins at version 1 again
  sender_ = FrameSender(server_.Connect());
  frames_ = RandomFrames(21);
  Push(5);
  const std::string hash = server_.Newest()->Hash();
  for (int i = 0; i < 1000 && dut->Latest()->Hash() != hash; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(dut->Latest()->Hash(), hash);
  EXPECT_EQ(dut->stats().full_syncs, 2u);
  EXPECT_GE(dut->state().reconnects, 1u);
}

TEST_F(MirrorTest, WaitingForWhatDoesNotComeEnds) {
  EXPECT_TRUE(
      absl::IsDeadlineExceeded(Follow()->WaitFor(99, std::chrono::milliseconds(20)).status()));
}

TEST_F(MirrorTest, NobodyAnswers) {
  const auto connection = server_.Connect({.retry_for = std::chrono::milliseconds(50)});
  server_.Stop();
  const absl::Status refused =
      Connection::Open("127.0.0.1:1", {.retry_for = std::chrono::milliseconds(50)}).status();
  EXPECT_TRUE(absl::IsUnavailable(refused)) << refused;
  const absl::Status lost = SceneClient(connection).GetStatus().status();
  EXPECT_TRUE(absl::IsUnavailable(lost)) << lost;
}

TEST_F(MirrorTest, AHundredClientsAtOnce) {
  std::atomic<int> good = 0;
  std::vector<std::thread> clients;
  for (int c = 0; c < 100; ++c) {
    clients.emplace_back([&, c] {
      const auto connection = Connection::Open(server_.address(), {.deadline = kPatience});
      if (!connection.ok()) return;
      Frame frame = testing_support::FrameAt(1);  // all of one instant: any order will do
      frame.sensor_id = "sensor " + std::to_string(c);
      testing_support::AddPoint(frame, kStaticLabel, {1.0 + 0.2 * c, 0, 0});
      auto ack = FrameSender(*connection).Push(frame);
      while (absl::IsResourceExhausted(ack.status())) ack = FrameSender(*connection).Push(frame);
      const auto mirror = SceneMirror::Follow(*connection);
      const auto objects = SceneClient(*connection).ListObjects();
      if (ack.ok() && mirror.ok() && objects.ok() &&
          (*mirror)->WaitFor(ack->version, kPatience).ok()) {
        ++good;
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(good, 100);
  EXPECT_EQ(SceneClient(server_.Connect()).GetStatus()->frames_applied, 100u);
}

}  // namespace
}  // namespace clearway
