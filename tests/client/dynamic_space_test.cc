// Dynamic space through client and server.
#include <gtest/gtest.h>

#include "clearway/client/frame_sender.h"
#include "clearway/client/scene_client.h"
#include "clearway/client/scene_mirror.h"
#include "clearway/io/octomap_file.h"
#include "support/test_server.h"
#include "support/wall_scans.h"

namespace clearway {
namespace {

using testing_support::Panel;
using testing_support::ScanOfWall;
using testing_support::TestServer;

class DynamicSpaceServed : public testing::Test {
 protected:
  static ServerConfig Config() {
    ServerConfig config = testing_support::SmallConfig();
    config.scene.resolution_m = config.scene.object_resolution_m = 0.1;
    config.scene.dynamic_life = std::chrono::milliseconds(500);
    return config;
  }
  // A second of scans of the wall, then one of the panel before it.
  PushAck Push(const Panel& panel) {
    FrameSender sender(connection_);
    absl::StatusOr<PushAck> ack;
    for (int k = 1; k <= 11; ++k) {
      Frame frame = ScanOfWall(0.1 * k, k == 11 ? std::optional(panel) : std::nullopt);
      frame.sequence = k;
      ack = sender.Push(frame);
      EXPECT_TRUE(ack.ok()) << ack.status();
    }
    return *ack;
  }

  TestServer server_{Config()};
  std::shared_ptr<Connection> connection_ = server_.Connect();
  SceneClient client_{connection_};
};

TEST_F(DynamicSpaceServed, IsToldOfPoints) {
  const Panel panel{5, 0};
  const Eigen::Vector3f wall(testing_support::kWall_m + 0.05, 1.5, 0.5);
  const std::vector<Eigen::Vector3f> points = {panel.Middle().cast<float>(), wall};
  const std::vector<Time> now = {testing_support::At(1.1)};
  ASSERT_GT(Push(panel).report.voxels_dynamic, 0u);
  const auto answers = client_.OccupancyOfPoints(points, now);
  ASSERT_TRUE(answers.ok()) << answers.status();
  EXPECT_EQ(answers->points[0].status, SpaceStatus::kOccupied);
  EXPECT_TRUE(answers->points[0].dynamic);
  EXPECT_EQ(answers->points[1].status, SpaceStatus::kOccupied);
  EXPECT_FALSE(answers->points[1].dynamic);
}

TEST_F(DynamicSpaceServed, IsInMirrors) {
  const std::uint64_t version = Push(Panel{5, 0}).version;
  const auto mirror = SceneMirror::Follow(server_.Connect(), {});
  ASSERT_TRUE(mirror.ok()) << mirror.status();
  const auto scene = (*mirror)->WaitFor(version, std::chrono::seconds(60));
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_FALSE((*scene)->dynamic_W.voxels().empty());
  EXPECT_TRUE(SameContent(**scene, *server_.Newest()));
}

TEST_F(DynamicSpaceServed, IsNotInExportsOfTheStaticMap) {
  const Panel panel{5, 0};
  Push(panel);
  std::string bytes;
  const auto exported =
      client_.ExportMap(StaticMapTarget{}, MapFormat::kOt, [&](std::string_view piece) {
        bytes += piece;
        return absl::OkStatus();
      });
  ASSERT_TRUE(exported.ok()) << exported.status();
  const auto file = ParseOctomap("static.ot", bytes);
  ASSERT_TRUE(file.ok()) << file.status();
  const VoxelMap& map = file->map;
  EXPECT_EQ(map.State(map.grid().KeyOf(panel.Middle())), VoxelState::kFree);
  EXPECT_EQ(server_.Newest()->static_map_W.State(map.grid().KeyOf(panel.Middle())),
            VoxelState::kOccupied);
}

}  // namespace
}  // namespace clearway
