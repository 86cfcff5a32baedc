// Sensor poses that are off, through client and server.
#include <gtest/gtest.h>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_mirror.h"
#include "support/rooms.h"
#include "support/test_server.h"

namespace clearway {
namespace {

using testing_support::ScanOfRoom;
using testing_support::TestServer;

Pose TrueT_W_S(int k) { return Pose::Translation(-1 + 0.1 * k, 0.2, 0.1); }
// The first one is right.
Pose ToldT_W_S(int k) { return Pose::Translation(0.02 * k, -0.03 * k, 0) * TrueT_W_S(k); }

class SensorPosesServed : public testing::Test {
 protected:
  static ServerConfig Config(double error_m) {
    ServerConfig config = testing_support::SmallConfig();
    config.scene.resolution_m = config.scene.object_resolution_m = 0.1;
    config.scene.sensor_pose_error_m = error_m;
    config.scene.sensor_pose_error_rad = error_m > 0 ? 0.03 : 0;
    return config;
  }
  static PushAck Push(TestServer& server, int count) {
    FrameSender sender(server.Connect());
    absl::StatusOr<PushAck> ack;
    for (int k = 0; k < count; ++k) {
      Frame frame = ScanOfRoom(0.1 * k, TrueT_W_S(k), ToldT_W_S(k));
      frame.sequence = k + 1;
      ack = sender.Push(frame);
      EXPECT_TRUE(ack.ok()) << ack.status();
    }
    return *ack;
  }
};

TEST_F(SensorPosesServed, AreMendedAndToldWhereTheyAreSaidToBeOff) {
  constexpr int kCount = 6, kLast = kCount - 1;
  TestServer server(Config(0.3));
  const PushAck ack = Push(server, kCount);
  ASSERT_TRUE(ack.report.T_W_S.has_value());
  const Eigen::Vector3d found = ack.report.T_W_S->translation;
  EXPECT_LT((found - TrueT_W_S(kLast).translation).norm(), 0.06);
  EXPECT_GT((ToldT_W_S(kLast).translation - TrueT_W_S(kLast).translation).norm(), 0.15);

  const auto connection = server.Connect();
  EXPECT_EQ(connection->server().params.sensor_pose_error_m, 0.3);
  EXPECT_EQ(connection->server().params.sensor_pose_error_rad, 0.03);

  const auto mirror = SceneMirror::Follow(connection, {});
  ASSERT_TRUE(mirror.ok()) << mirror.status();
  const auto scene = (*mirror)->WaitFor(ack.version, std::chrono::seconds(60));
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(SameContent(**scene, *server.Newest()));
}

TEST_F(SensorPosesServed, AreTakenAsTheyAreElse) {
  TestServer server(Config(0));
  EXPECT_EQ(Push(server, 3).report.T_W_S, ToldT_W_S(2));
}

}  // namespace
}  // namespace clearway
