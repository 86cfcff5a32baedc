// Mirrors, senders and watches, and a server that they lose.
#pragma once

#include <gtest/gtest.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clearway/client/frame_sender.h"
#include "clearway/client/remote_planner.h"
#include "clearway/client/scene_mirror.h"
#include "support/frames.h"
#include "support/test_server.h"

namespace clearway::testing_support {

inline constexpr Duration kPatience = std::chrono::seconds(60);

// Dead peers are found in seconds.
inline KeepaliveConfig QuickKeepalive() {
  return {std::chrono::seconds(1), std::chrono::seconds(3), std::chrono::milliseconds(500)};
}

inline ConnectionOptions Patient() {
  ConnectionOptions options;
  options.deadline = kPatience;
  return options;
}

inline Frame Numbered(std::uint64_t sequence) {
  Frame frame = FrameAt(0.1 * static_cast<double>(sequence));
  frame.sequence = sequence;
  AddPoint(frame, kStaticLabel, {3, 0.2 * static_cast<double>(sequence), 0});
  return frame;
}

class ReconnectTest : public testing::Test {
 protected:
  ReconnectTest() { Start(); }

  void Start(const std::string& address = "127.0.0.1:0", const KeepaliveConfig& keepalive = {}) {
    ServerConfig config = SmallConfig();
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
    options.heartbeat = std::chrono::milliseconds(100);
    options.reconnect.max_pause = std::chrono::milliseconds(200);
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
    ServerConfig config = SmallConfig();
    config.limits.max_follow_streams = config.limits.max_push_streams = 1;
    config.limits.max_watch_streams = 1;
    server_.emplace(config);
  }
  // Everything that counts someone who stays connected.
  std::uint64_t Streams() {
    const ServerCore& core = server_->core();
    return core.follow_streams.size() + core.push_streams.size() + core.watch_streams.size();
  }

  std::optional<TestServer> server_;
  std::mutex mutex_;
  std::vector<std::uint64_t> answered_;
};

inline ReconnectOptions Quickly() {
  ReconnectOptions options;
  options.max_pause = std::chrono::milliseconds(200);
  return options;
}

// A robot at rest above the origin for a second.
inline MotionBatch Waiting() {
  MotionBatch motions;
  motions.knot_counts = {2};
  motions.times = {Time() + std::chrono::seconds(100), Time() + std::chrono::seconds(101)};
  motions.T_W_L = {Pose::Translation(0, 0, 1), Pose::Translation(0, 0, 1)};
  motions.deviations_m = {0, 0};
  return motions;
}

inline MotionOptions UnknownIsFree() {
  MotionOptions options;
  options.check.unknown = UnknownPolicy::kFree;
  return options;
}

}  // namespace clearway::testing_support
