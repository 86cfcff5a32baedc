// The local checker against brute force, on scenes made of scans: a real drive and the simulator.
#include <gtest/gtest.h>

#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "collision/brute_force.h"
#include "collision/random_world.h"
#include "collision/tally.h"
#include "support/data_folder.h"

namespace clearway {
namespace {

ScenePtr SceneOf(const FrameSource& frames, std::size_t first, std::size_t count,
                 const SceneParams& params) {
  ThreadPool pool(2);
  SceneBuilder builder(params, {}, pool);
  for (std::size_t k = first; k < first + count; ++k) {
    const auto frame = frames.read(k);
    EXPECT_TRUE(frame.ok()) << frame.status();
    if (!frame.ok()) break;
    EXPECT_TRUE(builder.Apply(*frame).ok());
  }
  return builder.Publish();
}

// Points where something is: static voxels and the objects at some time.
struct Place {
  Eigen::Vector3d p_W;
  Time time;
};
std::vector<Place> PlacesIn(const SceneSnapshot& scene, RandomWorld& random, int count) {
  std::vector<Eigen::Vector3d> occupied_W;
  scene.static_map_W.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int i) { occupied_W.push_back(scene.static_map_W.grid().CenterOf(VoxelAt(key, i))); });
  });
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    constexpr double kTimes_s[] = {-0.5, 0, 0.7, 2, 8};
    Place place{occupied_W[random.Below(static_cast<int>(occupied_W.size()))],
                scene.stamp + FromSeconds(kTimes_s[random.Below(5)])};
    if (!scene.objects.empty() && random.Below(2)) {
      const auto& object = scene.objects[random.Below(static_cast<int>(scene.objects.size()))];
      place.p_W = PredictPose(*object, place.time, scene.params.horizon).T_W_O.translation;
    }
    place.p_W += random.Point({{-1.5, -1.5, -0.5}, {1.5, 1.5, 1.5}});
    places.push_back(place);
  }
  return places;
}

Tally CompareOn(const ScenePtr& scene, int robots, int states_each) {
  RandomWorld random(77);
  Tally tally;
  for (int r = 0; r < robots; ++r) {
    const Robot robot = Robot::SingleShape("r", random.ShapeOfKind(r % std::variant_size_v<Shape>));
    const CheckOptions options = random.Options(robot);
    const SceneChecker dut(scene, robot);
    for (const Place& place : PlacesIn(*scene, random, states_each)) {
      const Pose T_W_L = random.AnyPose({place.p_W, place.p_W});
      const auto reply = dut.Check({{place.time}, {T_W_L}}, options);
      EXPECT_TRUE(reply.ok()) << reply.status();
      if (!reply.ok()) continue;
      const BruteForce brute_force(scene, robot, options, Aabb{place.p_W, place.p_W}.Padded(1.7));
      tally.Compare(reply->answers[0], brute_force.Check(place.time, &T_W_L), options,
                    "robot " + std::to_string(r));
    }
  }
  tally.Print();
  return tally;
}

void ExpectManyCases(const Tally& tally) {
  EXPECT_LE(tally.unsure, tally.states / 100);
  EXPECT_GT(tally.Of(SpaceStatus::kOccupied), tally.states / 10);
  EXPECT_GT(tally.Of(SpaceStatus::kFree), tally.states / 50);
  EXPECT_GT(tally.Of(SpaceStatus::kUnknownSpace), tally.states / 50);
  EXPECT_GT(tally.with_object, tally.states / 20);
}

TEST(RecordedSceneTest, AgreesWithBruteForceOnASimulatedStreet) {
  ScenarioOptions options;
  options.beams = 16;
  options.azimuth_steps = 720;
  const auto simulation = MakeScenario("crossing", options);
  ASSERT_TRUE(simulation.ok()) << simulation.status();
  SceneParams params;
  params.resolution_m = params.object_resolution_m = simulation->spec().resolution_m;
  params.solid = SolidMode::kVoxels;
  const ScenePtr scene = SceneOf(simulation->Frames(), 10, 15, params);
  ASSERT_FALSE(scene->objects.empty());
  ExpectManyCases(CompareOn(scene, 12, 15));
}

TEST(RecordedSceneTest, AgreesWithBruteForceOnARealDrive) {
  const auto folder = DataPath("kitti0000_fov");
  if (!folder) GTEST_SKIP() << "no recorded data";
  const auto drive = OpenLidarFolder(*folder);
  ASSERT_TRUE(drive.ok()) << drive.status();
  SceneParams params;
  params.rays.max_range_m = 40;
  const ScenePtr scene = SceneOf(drive->frames, 20, 20, params);
  ASSERT_FALSE(scene->objects.empty());
  ExpectManyCases(CompareOn(scene, 18, 15));
}

}  // namespace
}  // namespace clearway
