#include "clearway/scene/scene_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "clearway/map/ray.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::At;
using testing_support::FrameAt;
using testing_support::Random;
using testing_support::RandomFrames;

class SceneBuilderTest : public testing::Test {
 protected:
  SceneBuilder Builder(const SceneParams& params = {}, const FrameLimits& limits = {}) {
    return SceneBuilder(params, limits, pool_);
  }
  static VoxelState StaticState(SceneBuilder& dut, const Eigen::Vector3d& p_W) {
    const ScenePtr scene = dut.Publish();
    return scene->static_map_W.State(scene->static_map_W.grid().KeyOf(p_W));
  }
  ThreadPool pool_{1};
};

TEST_F(SceneBuilderTest, Empty) {
  SceneBuilder dut = Builder();
  const ScenePtr scene = dut.Publish();
  EXPECT_EQ(scene->version, 1u);
  EXPECT_EQ(scene->static_map_W.observed_count(), 0);
  EXPECT_TRUE(scene->objects.empty());
}

TEST_F(SceneBuilderTest, VersionsCountChanges) {
  SceneBuilder dut = Builder();
  EXPECT_EQ(dut.Publish(), dut.Publish());
  ASSERT_TRUE(dut.Apply(FrameAt(1)).ok());
  EXPECT_EQ(dut.Publish()->version, 2u);
  EXPECT_EQ(dut.Publish()->stamp, At(1));
}

TEST_F(SceneBuilderTest, APublishedVersionNeverChanges) {
  SceneBuilder dut = Builder();
  RandomFrames frames(1);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(dut.Apply(frames.Next()).ok());
  const ScenePtr held = dut.Publish();
  const std::string hash = held->Hash();
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(dut.Apply(frames.Next()).ok());
  EXPECT_EQ(held->Hash(), hash);
  EXPECT_NE(dut.Publish()->Hash(), hash);
}

TEST_F(SceneBuilderTest, RaysThroughTooManyBlocksAreRefusedAndChangeNothing) {
  SceneBuilder dut = Builder();
  Frame near = FrameAt(1);
  AddPoint(near, kStaticLabel, {3, 0, 0});
  ASSERT_TRUE(dut.Apply(near).ok());
  const std::string hash = dut.Publish()->Hash();

  Frame far = FrameAt(2);
  for (int i = 0; i < 12; ++i) AddPoint(far, kStaticLabel, {90'000, 1'000.0 * i, 500.0 * i});
  const absl::Status refused = dut.Apply(far).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(refused.message(), testing::HasSubstr("points_m"));
  EXPECT_THAT(refused.message(), testing::HasSubstr("1048576"));
  EXPECT_EQ(dut.Publish()->Hash(), hash);

  SceneParams params;
  params.rays.max_range_m = 100;
  SceneBuilder limited = Builder(params);
  EXPECT_TRUE(limited.Apply(far).ok());
}

// Each passes few blocks, and those that the others pass.
TEST_F(SceneBuilderTest, RaysThroughTooManyVoxelsAreRefusedBeforeTheyAreCast) {
  FrameLimits limits;
  limits.max_ray_voxels = 100'000;
  SceneBuilder dut = Builder({}, limits);
  const auto bundle = [](int rays) {
    Frame frame = FrameAt(1);
    for (int i = 0; i < rays; ++i) AddPoint(frame, kStaticLabel, {90, 0, 0.001f * i});
    return frame;
  };
  const std::string hash = dut.Publish()->Hash();
  const absl::Status refused = dut.Apply(bundle(120)).status();
  EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_THAT(refused.message(), testing::HasSubstr("points_m: the rays pass 108"));
  EXPECT_THAT(refused.message(), testing::HasSubstr("the limit is 100000"));
  EXPECT_EQ(dut.Publish()->Hash(), hash);
  EXPECT_TRUE(dut.Apply(bundle(100)).ok());
}

TEST_F(SceneBuilderTest, MoreBlocksThanTheSceneMayHoldAreRefusedAndChangeNothing) {
  FrameLimits limits;
  limits.max_blocks = 20;
  SceneBuilder dut = Builder({}, limits);
  Frame near = FrameAt(1);
  AddPoint(near, kStaticLabel, {3, 0, 0});
  AddPoint(near, 7, {0, 3, 0});
  ASSERT_TRUE(dut.Apply(near).ok());
  const std::string hash = dut.Publish()->Hash();
  const std::pair<float, const char*> cases[] = {
      {12, "points_m: the scene's maps would hold 2"},  // 15 and those that are there
      {20, "points_m: the rays touch more than 20 blocks"}};
  for (const auto& [far_m, message] : cases) {
    for (const ObjectId label : {kStaticLabel, 7}) {
      Frame far = FrameAt(2);
      AddPoint(far, label, {0, -far_m, 0});
      const absl::Status refused = dut.Apply(far).status();
      EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
      EXPECT_THAT(refused.message(), testing::HasSubstr(message));
      EXPECT_EQ(dut.Publish()->Hash(), hash);
    }
  }
}

// As many blocks as points, of an object too: what each costs does not grow with their number.
TEST_F(SceneBuilderTest, PointsStrewnOverAllTheWorld) {
  testing_support::Random random(5);
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(1);
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d p = random.Vector(90'000);
    AddPoint(frame, i % 2 == 0 ? kStaticLabel : 7, p);
    frame.origins_S.push_back(p.cast<float>());
  }
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(dut.Publish()->static_map_W.blocks().size(), 10'000u);
  EXPECT_EQ(dut.Publish()->FindObject(7)->map_O.blocks().size(), 10'000u);
}

TEST_F(SceneBuilderTest, AStaticPointHitsAndItsRayClears) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, kStaticLabel, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kOccupied);
  EXPECT_EQ(StaticState(dut, {1.05, 0.05, 0.05}), VoxelState::kFree);
  EXPECT_EQ(StaticState(dut, {2.15, 0.05, 0.05}), VoxelState::kUnknown);
}

TEST_F(SceneBuilderTest, AnObjectsRayClearsTheStaticMapUpToItsEnd) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, 3, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(StaticState(dut, {1.95, 0.05, 0.05}), VoxelState::kFree);
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kUnknown);
  EXPECT_EQ(dut.Publish()->FindObject(3)->map_O.occupied_count(), 1);
}

TEST_F(SceneBuilderTest, AnEndVoxelOfAnObjectIsNotClearedByAnotherRay) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, 3, {2.05, 0.05, 0.05});
  AddPoint(frame, kStaticLabel, {4.05, 0.08, 0.08});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kUnknown);
  EXPECT_EQ(StaticState(dut, {3.05, 0.05, 0.05}), VoxelState::kFree);
}

TEST_F(SceneBuilderTest, AStaticPointInAnObjectsEndVoxelCounts) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, 3, {2.05, 0.05, 0.05});
  AddPoint(frame, kStaticLabel, {2.06, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kOccupied);
}

TEST_F(SceneBuilderTest, LeavesPointsOutAndCountsThem) {
  SceneParams params;
  params.self_filter_S = {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}};
  params.bounds_W = {{-10, -10, -10}, {10, 10, 10}};
  SceneBuilder dut = Builder(params);
  Frame frame = FrameAt(0);
  AddPoint(frame, kIgnoreLabel, {1, 0, 0});
  AddPoint(frame, kStaticLabel, {0.2, 0.2, 0});
  AddPoint(frame, kStaticLabel, {11, 0, 0});
  AddPoint(frame, kStaticLabel, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  AddPoint(frame, 4, {0, std::numeric_limits<double>::infinity(), 0});
  AddPoint(frame, kStaticLabel, {1, 0, 0});
  const auto report = dut.Apply(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->points_ignored, 1u);
  EXPECT_EQ(report->points_self, 1u);
  EXPECT_EQ(report->points_out_of_bounds, 1u);
  EXPECT_EQ(report->points_not_finite, 2u);
  EXPECT_EQ(report->points_used, 1u);
  EXPECT_EQ(dut.Publish()->static_map_W.occupied_count(), 1);
  EXPECT_TRUE(dut.Publish()->objects.empty());
}

TEST_F(SceneBuilderTest, AnObjectBeyondTheRangeIsNotHit) {
  SceneParams params;
  params.rays.max_range_m = 3;
  SceneBuilder dut = Builder(params);
  Frame frame = FrameAt(0);
  AddPoint(frame, 3, {5.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_TRUE(dut.Publish()->objects.empty());
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kFree);
}

TEST_F(SceneBuilderTest, AnObjectVoxelIsHitOncePerScan) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  for (int i = 0; i < 5; ++i) AddPoint(frame, 3, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  const VoxelMap& map = dut.Publish()->FindObject(3)->map_O;
  map.blocks().ForEach([&](BlockKey, const VoxelBlock& block) {
    block.observed.ForEach([&](int i) { EXPECT_EQ(block.log_odds[i], map.model().hit); });
  });
}

TEST_F(SceneBuilderTest, RaysClearTheObjectsOwnMapOnlyIfAsked) {
  for (bool clear : {false, true}) {
    SceneParams params;
    params.clear_objects_by_rays = clear;
    SceneBuilder dut = Builder(params);
    Frame first = FrameAt(0), second = FrameAt(0.1);
    for (double y : {-0.4, 0.0, 0.4}) AddPoint(first, 3, {2.05, y, 0.05});
    AddPoint(second, 3, {2.05, -0.4, 0.05});
    AddPoint(second, 3, {2.05, 0.4, 0.05});
    for (int i = 0; i < 3; ++i) AddPoint(second, kStaticLabel, {4.1, 0.01, 0.1});
    ASSERT_TRUE(dut.Apply(first).ok());
    const std::int64_t before = dut.Publish()->FindObject(3)->map_O.occupied_count();
    const Aabb box_O = dut.Publish()->FindObject(3)->observed_box_O;
    for (int k = 1; k < 6; ++k) {
      second.stamp = At(0.1 * k);
      ASSERT_TRUE(dut.Apply(second).ok());
    }
    EXPECT_EQ(dut.Publish()->FindObject(3)->map_O.occupied_count() < before, clear);
    EXPECT_EQ(dut.Publish()->FindObject(3)->observed_box_O, box_O) << "no free space around it";
  }
}

TEST_F(SceneBuilderTest, RefusesStampsThatGoBackAndChangesNothing) {
  SceneBuilder dut = Builder();
  ASSERT_TRUE(dut.Apply(FrameAt(2)).ok());
  const std::string hash = dut.Publish()->Hash();
  Frame frame = FrameAt(1);
  AddPoint(frame, kStaticLabel, {1, 1, 1});
  const auto status = dut.Apply(frame).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), testing::StartsWith("stamp_ns"));
  EXPECT_EQ(dut.Publish()->Hash(), hash);
  EXPECT_TRUE(dut.Apply(FrameAt(2)).ok()) << "another sensor's frame of the same time";
}

TEST_F(SceneBuilderTest, RefusesTooManyObjectsAndChangesNothing) {
  SceneBuilder dut = Builder({}, {.max_objects = 2});
  Frame frame = FrameAt(0);
  for (ObjectId id = 1; id <= 3; ++id) AddPoint(frame, id, {1.0 * id, 0, 0});
  const std::string hash = dut.Publish()->Hash();
  EXPECT_EQ(dut.Apply(frame).status().code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(dut.Publish()->Hash(), hash);
}

TEST_F(SceneBuilderTest, LeavesOutAPoseThatPutsAnObjectBeyondTheLimits) {
  SceneBuilder dut = Builder({}, {.max_coordinate_m = 100});
  Frame frame = FrameAt(0);
  AddPoint(frame, 3, {1, 0, 0});
  frame.poses = {{3, Pose::Translation(-50, 0, 0)}};  // 51 m from the object
  ASSERT_TRUE(dut.Apply(frame).ok());
  frame = FrameAt(1);
  frame.poses = {{3, Pose::Translation(90, 0, 0)}};
  const auto report = dut.Apply(frame);
  ASSERT_TRUE(report.ok()) << report.status();
  ASSERT_EQ(report->issues.size(), 1u);
  EXPECT_EQ(report->issues[0].kind, ObjectIssueKind::kMotionTooFar);
  EXPECT_EQ(dut.Publish()->FindObject(3)->t_k(), At(0));
}

TEST_F(SceneBuilderTest, TheSameScenesWithAnyNumberOfThreads) {
  std::set<std::string> hashes;
  for (int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    SceneBuilder dut({}, {}, pool);
    RandomFrames frames(11);
    for (int k = 0; k < 30; ++k) ASSERT_TRUE(dut.Apply(frames.Next()).ok());
    hashes.insert(dut.Publish()->Hash());
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST_F(SceneBuilderTest, APriorReplacesWhatItHasObserved) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, kStaticLabel, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  VoxelMap prior(0.1);
  prior.Set({20, 0, 0}, -500);
  prior.Set({50, 0, 0}, 500);
  ASSERT_TRUE(dut.LoadPrior(prior).ok());
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kFree);
  EXPECT_EQ(StaticState(dut, {5.05, 0.05, 0.05}), VoxelState::kOccupied);
  EXPECT_EQ(StaticState(dut, {1.05, 0.05, 0.05}), VoxelState::kFree);
}

TEST_F(SceneBuilderTest, RefusesAPriorOfMoreBlocksThanAllowedWhole) {
  FrameLimits limits;
  limits.max_blocks = 3;
  SceneBuilder dut({}, limits, pool_);
  Frame frame = FrameAt(0);
  AddPoint(frame, kStaticLabel, {0.25, 0.05, 0.05});  // one block
  ASSERT_TRUE(dut.Apply(frame).ok());
  const std::string hash = dut.Publish()->Hash();
  VoxelMap prior(0.1);
  for (int x = 0; x < 4; ++x) prior.Set({8 * x, 0, 0}, 500);
  const absl::Status refused = dut.LoadPrior(prior);
  EXPECT_EQ(refused.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_NE(refused.message().find("4 blocks; the limit is 3"), std::string::npos) << refused;
  EXPECT_EQ(dut.Publish()->Hash(), hash);
  VoxelMap smaller(0.1);
  for (int x = 0; x < 3; ++x) smaller.Set({8 * x, 0, 0}, 500);
  EXPECT_TRUE(dut.LoadPrior(smaller).ok());  // one of its blocks is there already
  EXPECT_EQ(StaticState(dut, {1.65, 0.05, 0.05}), VoxelState::kOccupied);
}

TEST_F(SceneBuilderTest, ObjectsCountForTheBlocksOfAPrior) {
  FrameLimits limits;
  limits.max_blocks = 3;
  SceneBuilder dut({}, limits, pool_);
  Frame frame = FrameAt(0);
  AddPoint(frame, 1, {0.25, 0.05, 0.05});  // a block of free space, and one of the object's
  ASSERT_TRUE(dut.Apply(frame).ok());
  VoxelMap prior(0.1);
  prior.Set({80, 0, 0}, 500);
  EXPECT_TRUE(dut.LoadPrior(prior).ok());
  prior.Set({160, 0, 0}, 500);
  EXPECT_EQ(dut.LoadPrior(prior).code(), absl::StatusCode::kResourceExhausted);
}

TEST_F(SceneBuilderTest, RefusesAPriorOfAnotherResolution) {
  SceneBuilder dut = Builder();
  EXPECT_EQ(dut.LoadPrior(VoxelMap(0.2)).code(), absl::StatusCode::kInvalidArgument);
}

TEST_F(SceneBuilderTest, AClearedRegionIsUnknown) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0);
  AddPoint(frame, kStaticLabel, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  dut.ClearRegion({{1, -1, -1}, {3, 1, 1}});
  EXPECT_EQ(StaticState(dut, {2.05, 0.05, 0.05}), VoxelState::kUnknown);
  EXPECT_EQ(StaticState(dut, {0.55, 0.05, 0.05}), VoxelState::kFree);
}

TEST_F(SceneBuilderTest, ResetForgetsAllButGoesOnCounting) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(5);
  AddPoint(frame, 3, {2.05, 0.05, 0.05});
  ASSERT_TRUE(dut.Apply(frame).ok());
  const std::uint64_t version = dut.Publish()->version;
  dut.Reset();
  EXPECT_EQ(dut.Publish()->version, version + 1);
  EXPECT_TRUE(SameContent(*dut.Publish(), SceneSnapshot::Empty({})));
  EXPECT_TRUE(dut.Apply(FrameAt(1)).ok()) << "an earlier stamp is fine again";
}

}  // namespace
}  // namespace clearway
