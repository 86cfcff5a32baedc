#include "clearway/scene/occupancy.h"

#include <gtest/gtest.h>

#include <array>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random_given.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;
using testing_support::Random;
using testing_support::RandomFrames;

// Every voxel and solid of every map, without any box or early exit.
PointOccupancy BruteForce(const SceneSnapshot& scene, const Eigen::Vector3d& p_W, Time t) {
  if (!scene.params.bounds_W.Contains(p_W)) return {SpaceStatus::kOutOfBounds, 0, std::nullopt};
  PointOccupancy answer{SpaceStatus::kUnknownSpace, 0, std::nullopt};
  const auto look = [&](const VoxelMap& map, const Eigen::Vector3d& p) {
    VoxelState state = VoxelState::kUnknown;
    map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
      block.observed.ForEach([&](int i) {
        const VoxelKey voxel = VoxelAt(key, i);
        const Eigen::Array3d low =
            map.grid().resolution_m() * Eigen::Array3d(voxel.x, voxel.y, voxel.z);
        const Eigen::Array3d high = low + map.grid().resolution_m();
        if ((p.array() < low).any() || (p.array() >= high).any()) return;
        state = block.log_odds[i] >= 0 ? VoxelState::kOccupied : VoxelState::kFree;
        answer.fused_log_odds = answer.fused_log_odds.value_or(0) + block.log_odds[i] / 4096.0;
      });
    });
    return state;
  };
  const VoxelState fixed = look(scene.static_map_W, p_W);
  if (fixed == VoxelState::kFree) answer.status = SpaceStatus::kFree;
  bool occupied = fixed == VoxelState::kOccupied;
  for (const Aabb& box : scene.params.keep_out_W) occupied = occupied || box.Contains(p_W);
  if (occupied) answer.status = SpaceStatus::kOccupied;
  for (const auto& object : scene.objects) {
    const PredictedPose predicted = PredictPose(*object, t, scene.params.horizon);
    SpaceStatus says = SpaceStatus::kFree;
    if (predicted.beyond_horizon_radius_m) {
      if ((p_W - predicted.T_W_O.translation).norm() <= *predicted.beyond_horizon_radius_m) {
        says = SpaceStatus::kBeyondHorizon;
      }
    } else {
      const Eigen::Vector3d p_O = Inverse(predicted.T_W_O) * p_W;
      const bool in_hull =
          object->FillsSolid(scene.params.solid) && NearHull(*object->solid->hull, p_O, 0);
      if (look(object->map_O, p_O) == VoxelState::kOccupied || in_hull)
        says = SpaceStatus::kOccupied;
    }
    if (says > answer.status) {
      answer.status = says;
      answer.object = object->id;
    }
  }
  return answer;
}

TEST(Occupancy, EmptySceneIsUnknown) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  const PointOccupancy answer = SceneAtTime(scene, At(0)).At({1, 2, 3});
  EXPECT_EQ(answer.status, SpaceStatus::kUnknownSpace);
  EXPECT_FALSE(answer.fused_log_odds);
}

TEST(Occupancy, AgreesWithBruteForceOnRandomScenes) {
  Random random(1);
  std::array<int, 6> seen{};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    ThreadPool pool(1);
    SceneParams params;
    params.resolution_m = params.object_resolution_m = 0.4;
    params.solid = static_cast<SolidMode>(seed % 3);
    params.bounds_W = {{-9, -9, -9}, {9, 9, 9}};
    params.keep_out_W = {{{-6, -6, -6}, {-5, -5, -5}}};
    params.horizon = std::chrono::seconds(1);
    SceneBuilder builder(params, {}, pool);
    RandomFrames frames(seed);
    for (int k = 0; k < 12; ++k) {
      ASSERT_TRUE(builder.Apply(frames.Next()).ok());
      testing_support::ChangeGivenRandomly(builder, random);
    }
    const ScenePtr scene = builder.Publish();
    for (double ahead_s : {-1.0, 0.0, 0.5, 2.0}) {
      const Time t = scene->stamp + FromSeconds(ahead_s);
      const SceneAtTime dut(*scene, t);
      for (int i = 0; i < 150; ++i) {
        Eigen::Vector3d p_W = random.Vector(9.5);
        if (!scene->objects.empty() && i % 2 == 0) {
          const auto& object = *scene->objects[i / 2 % scene->objects.size()];
          p_W = PredictPose(object, t, params.horizon).T_W_O * random.Vector(1.2);
        }
        const PointOccupancy expected = BruteForce(*scene, p_W, t), answer = dut.At(p_W);
        EXPECT_EQ(answer.status, expected.status);
        EXPECT_EQ(answer.object, expected.object);
        ASSERT_EQ(answer.fused_log_odds.has_value(), expected.fused_log_odds.has_value());
        EXPECT_NEAR(answer.fused_log_odds.value_or(0), expected.fused_log_odds.value_or(0), 1e-9);
        ++seen[static_cast<int>(answer.status)];
      }
    }
  }
  for (int status = 0; status <= 4; ++status)
    EXPECT_GT(seen[status], 20) << "status " << status << " hardly tested";
}

TEST(Occupancy, BatchesMixTimes) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame frame = FrameAt(0.1);
  AddObject(frame, 2, Pose::Translation(3, 0, 0), BoxSurface({0.5, 0.5, 0.5}, 0.05));
  frame.motions.push_back({2, Pose::Translation(0, 0.1, 0), At(0)});
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr scene = builder.Publish();
  const std::vector<Eigen::Vector3d> points(3, Eigen::Vector3d(3, 1, 0));
  const std::vector<Time> times{At(0.1), At(1.1), At(2.1)};
  const auto answers = OccupancyOf(*scene, points, times);
  EXPECT_EQ(answers[0].status, SpaceStatus::kUnknownSpace);
  EXPECT_EQ(answers[1].status, SpaceStatus::kOccupied);
  EXPECT_EQ(answers[1].object, 2);
  EXPECT_EQ(answers[2].status, SpaceStatus::kUnknownSpace);
}

TEST(Occupancy, ACellThatAnObjectHasLeftKeepsItsStaticState) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame wall = FrameAt(0);
  AddPoint(wall, kStaticLabel, {6, 0.05, 0.05});
  ASSERT_TRUE(builder.Apply(wall).ok());
  Frame frame = FrameAt(0.1);
  AddObject(frame, 2, Pose::Translation(3, 0, 0), BoxSurface({0.5, 0.5, 0.5}, 0.05));
  frame.motions.push_back({2, Pose::Translation(0, 0.2, 0), At(0)});
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr scene = builder.Publish();
  EXPECT_EQ(SceneAtTime(*scene, At(0.1)).At({3, 0.05, 0.05}).status, SpaceStatus::kOccupied);
  EXPECT_EQ(SceneAtTime(*scene, At(1.1)).At({3, 0.05, 0.05}).status, SpaceStatus::kFree);
}

TEST(QueryRay, FindsTheFirstHitAndTheFirstUnknown) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame wall = FrameAt(0);
  AddPoint(wall, kStaticLabel, {2.05, 0.05, 0.05});
  wall.T_W_S = Pose::Translation(0.05, 0.05, 0.05);
  wall.points_S[0] = {2.0f, 0, 0};
  ASSERT_TRUE(builder.Apply(wall).ok());
  const ScenePtr scene = builder.Publish();
  const SceneAtTime dut(*scene, At(0));
  const RayAnswer forward = CastQueryRay(dut, {0.05, 0.05, 0.05}, {2, 0, 0}, 10);
  ASSERT_TRUE(forward.first_hit_m);
  EXPECT_NEAR(*forward.first_hit_m, 1.95, 1e-6);
  EXPECT_FALSE(forward.first_unknown_m);
  const RayAnswer sideways = CastQueryRay(dut, {0.05, 0.05, 0.05}, {0, 1, 0}, 10);
  EXPECT_FALSE(sideways.first_hit_m);
  EXPECT_NEAR(*sideways.first_unknown_m, 0.05, 1e-6);
}

TEST(QueryRay, HitsAMovingObjectWhereItWillBe) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame frame = FrameAt(0.1);
  AddObject(frame, 2, Pose::Translation(3, 0, 0), BoxSurface({0.5, 0.5, 0.5}, 0.05));
  frame.motions.push_back({2, Pose::Translation(0.1, 0, 0), At(0)});
  ASSERT_TRUE(builder.Apply(frame).ok());
  const ScenePtr scene = builder.Publish();
  const RayAnswer answer =
      CastQueryRay(SceneAtTime(*scene, At(2.1)), {0, 0.01, 0.01}, {1, 0, 0}, 10);
  ASSERT_TRUE(answer.first_hit_m);
  EXPECT_NEAR(*answer.first_hit_m, 4.75, 0.15);
  EXPECT_EQ(answer.object, 2);
}

}  // namespace
}  // namespace clearway
