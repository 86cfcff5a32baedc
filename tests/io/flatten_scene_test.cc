#include "clearway/io/flatten_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/io/octomap_file.h"
#include "clearway/io/ply.h"
#include "clearway/scene/scene_builder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

constexpr ObjectId kCar = 4;

Time At(double seconds) { return Time(FromSeconds(seconds)); }

// A wall, and a box of 1 m before it that moves 2 m/s along y; two frames, at 0 and 0.5 s.
ScenePtr MovingBox(SceneParams params = {}) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (int k = 0; k < 2; ++k) {
    Frame frame;
    frame.sensor_id = "s";
    frame.sequence = static_cast<std::uint64_t>(k);
    frame.stamp = At(0.5 * k);
    frame.T_W_S = Pose::Translation(0.05, 0.05, 0.05);
    for (int i = -40; i <= 40; ++i) {
      frame.points_S.emplace_back(8.0f, 0.1f * i, 0.0f);
      frame.labels.push_back(kStaticLabel);
    }
    for (int i = 0; i < 1000; ++i) {
      frame.points_S.emplace_back(4 + 0.1f * (i % 10), k + 0.1f * (i / 10 % 10), 0.1f * (i / 100));
      frame.labels.push_back(kCar);
    }
    if (k == 1) frame.motions.push_back({kCar, Pose::Translation(0, 1, 0), At(0)});
    EXPECT_TRUE(builder.Apply(frame).ok());
  }
  return builder.Publish();
}

VoxelState StateAt(const VoxelMap& map, double x, double y, double z) {
  return map.State(map.grid().KeyOf({x, y, z}));
}

TEST(FlattenScene, Empty) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  const auto dut = FlattenScene(SceneAtTime(scene, At(0)));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->observed_count(), 0);
}

// Thinner than a voxel, and between the voxels' centres.
TEST(FlattenScene, AGivenDoorIsNotLost) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  const GivenObject door{3, Box{{1, 0.02, 2}}, {At(0), Pose::Translation(2, 0.2, 1)}, {}, {}};
  ASSERT_TRUE(builder.AddObject(door).ok());
  const auto dut = FlattenScene(SceneAtTime(*builder.Publish(), At(5)));
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (double x = 1.55; x < 2.5; x += 0.1) {
    for (double z = 0.05; z < 2; z += 0.1) {
      EXPECT_EQ(StateAt(*dut, x, 0.19, z), VoxelState::kOccupied);
      EXPECT_EQ(StateAt(*dut, x, 0.21, z), VoxelState::kOccupied);
      EXPECT_NE(StateAt(*dut, x, 0.45, z), VoxelState::kOccupied);
    }
  }
}

TEST(FlattenScene, PutsObjectsWhereTheyAreAtTheTime) {
  const ScenePtr scene = MovingBox();
  for (const double seconds : {0.0, 0.5, 1.5}) {
    const auto dut = FlattenScene(SceneAtTime(*scene, At(seconds)));
    ASSERT_TRUE(dut.ok()) << dut.status();
    const double y = 2 * seconds + 0.5;
    EXPECT_EQ(StateAt(*dut, 4.5, y, 0.5), VoxelState::kOccupied) << seconds;
    EXPECT_NE(StateAt(*dut, 4.5, y - 1.5, 0.5), VoxelState::kOccupied) << seconds;
    EXPECT_NE(StateAt(*dut, 4.5, y + 1.5, 0.5), VoxelState::kOccupied) << seconds;
    EXPECT_EQ(StateAt(*dut, 8.05, -1, 0.05), VoxelState::kOccupied);
  }
}

TEST(FlattenScene, AgreesWithTheSceneAtEveryVoxel) {
  const ScenePtr scene = MovingBox();
  const SceneAtTime placed(*scene, At(1.3));
  const auto dut = FlattenScene(placed);
  ASSERT_TRUE(dut.ok()) << dut.status();
  std::int64_t occupied = 0, more = 0;
  for (int x = 0; x < 100; ++x) {
    for (int y = -50; y < 50; ++y) {
      for (int z = -5; z < 15; ++z) {
        const Eigen::Vector3d p_W = dut->grid().CenterOf({x, y, z});
        const bool here = dut->State({x, y, z}) == VoxelState::kOccupied;
        const SpaceStatus status = placed.At(p_W).status;
        occupied += here;
        more += here && status != SpaceStatus::kOccupied;
        EXPECT_TRUE(here || status != SpaceStatus::kOccupied) << p_W;
        if (status == SpaceStatus::kUnknownSpace && !here) {
          EXPECT_EQ(dut->State({x, y, z}), VoxelState::kUnknown);
        }
      }
    }
  }
  EXPECT_GT(occupied, 1000);
  EXPECT_LT(more, occupied / 4);  // voxels that an object only reaches into
}

TEST(FlattenScene, LeavesTheSceneAsItIs) {
  const ScenePtr scene = MovingBox();
  const std::string before = scene->Hash();
  ASSERT_TRUE(FlattenScene(SceneAtTime(*scene, At(1))).ok());
  EXPECT_EQ(scene->Hash(), before);
}

TEST(FlattenScene, HoldsKeepOutZones) {
  SceneParams params;
  params.keep_out_W = {{{6, 0, 0}, {1e5, 1, 1}}};  // as far as anything is known
  const ScenePtr scene = MovingBox(params);
  const auto dut = FlattenScene(SceneAtTime(*scene, At(0.5)));
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(StateAt(*dut, 7, 0.5, 0.05), VoxelState::kOccupied);
  EXPECT_EQ(StateAt(*dut, 9, 0.5, 0.05), VoxelState::kUnknown);
}

TEST(FlattenScene, BlocksWhatAnObjectMayHaveReachedBeyondTheHorizon) {
  SceneParams params;
  params.horizon = FromSeconds(0.5);
  const ScenePtr scene = MovingBox(params);
  const SceneAtTime placed(*scene, At(2));
  ASSERT_TRUE(placed.objects()[0].beyond_horizon_radius_m.has_value());
  const auto dut = FlattenScene(placed);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(placed.At({5.55, 3.05, 0.05}).status, SpaceStatus::kBeyondHorizon);
  EXPECT_EQ(StateAt(*dut, 5.55, 3.05, 0.05), VoxelState::kOccupied);
}

TEST(FlattenScene, RefusesMoreVoxelsThanTheLimit) {
  const auto dut = FlattenScene(SceneAtTime(*MovingBox(), At(0)), 100);
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kResourceExhausted);
}

TEST(FlattenScene, EndsOnceItIsCancelled) {
  const auto dut = FlattenScene(SceneAtTime(*MovingBox(), At(0)), 1 << 28, [] { return true; });
  EXPECT_TRUE(absl::IsCancelled(dut.status())) << dut.status();
}

TEST(FlattenScene, GoesIntoFiles) {
  TemporaryFolder folder;
  const ScenePtr scene = MovingBox();
  const SceneAtTime placed(*scene, At(1));
  ASSERT_TRUE(WriteSceneAsOctomap(folder / "s.bt", placed).ok());
  ASSERT_TRUE(WriteSceneAsPly(folder / "s.ply", placed, PlyStyle::kPoints).ok());
  const auto dut = ReadOctomap(folder / "s.bt");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->map.occupied_count(), FlattenScene(placed)->occupied_count());
  const std::int64_t voxels =
      scene->static_map_W.occupied_count() + scene->objects[0]->map_O.occupied_count();
  EXPECT_THAT(BytesOf(folder / "s.ply"),
              ::testing::HasSubstr("element vertex " + std::to_string(voxels) + "\n"));
}

}  // namespace
}  // namespace clearway
