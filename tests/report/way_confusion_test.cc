#include "clearway/report/way_confusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clearway/scene/scene_builder.h"
#include "report/test_scene.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::FrameAt;
using Counts = Confusion::Counts;

// Object 3, a box of 2 m, goes 1 m/s along x for ten seconds; from `until_s` on nobody tells.
Truth Moving(double until_s = 10) {
  Truth truth;
  truth.end = testing_support::At(10);
  truth.boxes = [until_s](Time t) {
    const double x_m = ToSeconds(t - Time());
    if (x_m > until_s) return std::vector<TrueBox>{};
    return std::vector<TrueBox>{{3, {2, 2, 2}, Pose::Translation(x_m, 0, 1)}};
  };
  return truth;
}

// All of the way is free, and so is what lies around it.
SceneSnapshot FreeScene() {
  SceneSnapshot scene = SceneSnapshot::Empty({});
  const VoxelGrid& grid = scene.static_map_W.grid();
  const VoxelKey first = grid.KeyOf({-2, -2, -1}), last = grid.KeyOf({13, 2, 3});
  for (VoxelKey key = first; key.z <= last.z; ++key.z) {
    for (key.y = first.y; key.y <= last.y; ++key.y) {
      for (key.x = first.x; key.x <= last.x; ++key.x) scene.static_map_W.Set(key, -4000);
    }
  }
  return scene;
}

Counts Single(Confusion::Said said, std::int64_t count) {
  Counts counts{};
  counts[said] = count;
  return counts;
}

Confusion ConfusionOf(const SceneSnapshot& scene, const Truth& truth = Moving()) {
  WayConfusion dut(truth, {Duration::zero()});
  dut.Add(scene, Eigen::Vector3d::Zero());
  return dut.Result()[0];
}

// The grid is at 0.05 m, 0.45 m and so on, along each axis.
TEST(WayConfusion, TellsOfAMapThatKnowsNoObjects) {
  const Confusion confusion = ConfusionOf(FreeScene());
  // In the middle 1.2 m of the box at x = 0, each way.
  EXPECT_EQ(confusion.truly_occupied, Single(Confusion::kFree, 3 * 3 * 3));
  // From x = 1.3 to 11, 2 m wide, and 1.7 m high above what is near the ground.
  EXPECT_EQ(confusion.truly_free, Single(Confusion::kFree, 24 * 5 * 4));
}

TEST(WayConfusion, TellsOfAnEmptyMap) {
  const Confusion confusion = ConfusionOf(SceneSnapshot::Empty({}));
  EXPECT_EQ(confusion.truly_occupied, Single(Confusion::kUnknown, 3 * 3 * 3));
  EXPECT_EQ(confusion.truly_free, Single(Confusion::kUnknown, 24 * 5 * 4));
  EXPECT_EQ(Confusion::Share(confusion.truly_free, Confusion::kUnknown), 1);
  EXPECT_TRUE(std::isnan(Confusion::Share(Counts{}, Confusion::kFree)));
}

TEST(WayConfusion, TellsOfWhatIsLeftBehind) {
  SceneSnapshot scene = FreeScene();
  const VoxelGrid grid = scene.static_map_W.grid();
  scene.static_map_W.Set(grid.KeyOf({6.15, 0.05, 0.85}), 4000);  // not one of the grid
  scene.static_map_W.Set(grid.KeyOf({6.05, 0.05, 0.85}), 4000);  // one
  EXPECT_EQ(ConfusionOf(scene).truly_free[Confusion::kOccupied], 1);
  // Where the box is, it is no mistake.
  scene.stamp = testing_support::At(6);
  EXPECT_EQ(ConfusionOf(scene).truly_free[Confusion::kOccupied], 0);
}

TEST(WayConfusion, AddsUp) {
  WayConfusion dut(Moving(), {Duration::zero()});
  SceneSnapshot scene = FreeScene();
  dut.Add(scene, Eigen::Vector3d::Zero());
  scene.stamp = testing_support::At(5);  // as much of the way lies behind it and before it
  dut.Add(scene, Eigen::Vector3d::Zero());
  EXPECT_EQ(dut.Result()[0].truly_free, Single(Confusion::kFree, 2 * 24 * 5 * 4));
  EXPECT_EQ(dut.Result()[0].truly_occupied, Single(Confusion::kFree, 2 * 3 * 3 * 3));
}

TEST(WayConfusion, LooksNoFartherThanTheSensor) {
  SceneSnapshot scene = FreeScene();
  scene.params.rays.max_range_m = 0.5;
  const Confusion confusion = ConfusionOf(scene);
  EXPECT_EQ(confusion.truly_free, Counts{});
  EXPECT_LT(confusion.truly_occupied[Confusion::kFree], 3 * 3 * 3);
}

// Where an object passes of which nothing is told at the time, it may be.
TEST(WayConfusion, IsSilentOfWhatNobodyKnows) {
  SceneSnapshot scene = FreeScene();
  scene.stamp = testing_support::At(8);
  const Confusion confusion = ConfusionOf(scene, Moving(7));
  EXPECT_EQ(confusion.truly_free, Counts{});
  EXPECT_EQ(confusion.truly_occupied, Counts{});
}

// Stamps may leap by years, in which nothing is told: they are not looked through.
TEST(WayConfusion, LooksWhereBoxesAreTold) {
  const Time later = testing_support::At(2e9);
  Truth truth = Moving(2);
  truth.end = later + std::chrono::seconds(1);
  truth.boxes = [boxes = truth.boxes, later](Time t) {
    return boxes(t < later ? t : t - (later - Time()));
  };
  for (int k = 0; k <= 20; ++k) truth.told.push_back(testing_support::At(0.1 * k));
  for (int k = 0; k <= 10; ++k) truth.told.push_back(later + FromSeconds(0.1 * k));
  const Confusion confusion = ConfusionOf(FreeScene(), truth);
  EXPECT_EQ(confusion.truly_occupied, Single(Confusion::kFree, 3 * 3 * 3));
  EXPECT_EQ(confusion.truly_free, ConfusionOf(FreeScene(), Moving(2)).truly_free);
}

// A second box, 4 m to the side, has a way of its own.
TEST(WayConfusion, TellsOfEachObject) {
  Truth truth = Moving();
  truth.boxes = [boxes = truth.boxes](Time t) {
    std::vector<TrueBox> two = boxes(t);
    two.push_back({4, {2, 2, 2}, Pose::Translation(0, 4, 1)});
    return two;
  };
  WayConfusion dut(truth, {Duration::zero()});
  SceneSnapshot scene = FreeScene();
  scene.static_map_W.Set(scene.static_map_W.grid().KeyOf({6.05, 0.05, 0.85}), 4000);
  dut.Add(scene, Eigen::Vector3d::Zero());
  ASSERT_EQ(dut.ByObject().size(), 2u);
  const Confusion moving = dut.ByObject().at(3)[0], standing = dut.ByObject().at(4)[0];
  EXPECT_EQ(moving.truly_occupied, Single(Confusion::kFree, 3 * 3 * 3));
  EXPECT_EQ(moving.truly_free[Confusion::kOccupied], 1);
  EXPECT_EQ(moving.truly_free[Confusion::kFree], 24 * 5 * 4 - 1);
  EXPECT_EQ(standing.truly_occupied[Confusion::kOccupied], 0);
  EXPECT_GT(standing.truly_occupied[Confusion::kUnknown], 0);  // the free space ends before it
  EXPECT_EQ(standing.truly_free, Counts{});
}

// An object that goes on as it did is where it is predicted.
TEST(WayConfusion, TellsOfPredictions) {
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, {}, pool);
  for (const double t : {0.0, 0.5, 1.0}) {
    Frame frame = FrameAt(t);
    const Pose T_W_B = Pose::Translation(t, 0, 1);
    testing_support::AddObject(frame, 3, T_W_B, testing_support::BoxSurface({2, 2, 2}, 0.1));
    frame.poses.push_back({3, T_W_B});
    ASSERT_TRUE(builder.Apply(frame).ok());
  }
  WayConfusion dut(Moving(), {FromSeconds(2), FromSeconds(20)});
  dut.Add(*builder.Publish(), Eigen::Vector3d::Zero());
  EXPECT_EQ(Confusion::Share(dut.Result()[0].truly_occupied, Confusion::kOccupied), 1);
  EXPECT_EQ(dut.Result()[0].truly_free[Confusion::kOccupied], 0);
  EXPECT_EQ(dut.Result()[1].truly_occupied, Counts{});  // after the truth's end
}

}  // namespace
}  // namespace clearway
