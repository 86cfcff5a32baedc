#include "clearway/report/unlabelled_score.h"

#include <gtest/gtest.h>

#include "report/test_scene.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;

// Object 3, a box of 1 m, goes 1 m/s along x; object 4 stands elsewhere.
Truth Moving() {
  Truth truth;
  truth.end = Time(std::chrono::hours(1));
  truth.boxes = [](Time t) {
    const double x_m = ToSeconds(t - Time());
    return std::vector<TrueBox>{{3, {1, 1, 1}, Pose::Translation(x_m, 0, 0)},
                                {4, {1, 1, 1}, Pose::Translation(0, 9, 0)}};
  };
  return truth;
}

// The frame at x = t with two points on object 3, at its front, and one each on the ground and
// on 4.
Frame SeenAt(double t) {
  Frame frame = FrameAt(t);
  AddPoint(frame, 3, {t + 0.45, 0.05, 0.05});
  AddPoint(frame, 3, {t + 0.45, 0.25, 0.05});
  AddPoint(frame, kStaticLabel, {t + 0.45, 0.05, -0.55});
  AddPoint(frame, 4, {0.05, 8.55, 0.05});
  return frame;
}

SceneSnapshot SceneAt(double t) {
  SceneSnapshot scene = SceneSnapshot::Empty(SceneParams{});
  scene.stamp = testing_support::At(t);
  return scene;
}

VoxelKey KeyAt(double x_m, double y_m, double z_m) { return VoxelGrid(0.1).KeyOf({x_m, y_m, z_m}); }

TEST(UnlabelledScore, Empty) {
  EXPECT_TRUE(std::isnan(UnlabelledScore(Moving(), {3}).Result().ShareOccupied()));
}

TEST(UnlabelledScore, CountsWhatIsOccupiedAtOnceAndWhatStays) {
  UnlabelledScore dut(Moving(), {3});
  SceneSnapshot scene = SceneAt(0);
  scene.static_map_W.Set(KeyAt(0.45, 0.05, 0.05), 5000);
  scene.static_map_W.Set(KeyAt(0.45, 0.05, -0.55), 5000);
  dut.Add(SeenAt(0), scene);
  EXPECT_EQ(dut.Result().points, 2);
  EXPECT_EQ(dut.Result().points_occupied, 1);
  EXPECT_EQ(dut.Result().trail, 0);  // it is there

  scene.stamp = testing_support::At(3);
  dut.Add(SeenAt(3), scene);
  EXPECT_EQ(dut.Result().points, 4);
  EXPECT_EQ(dut.Result().points_occupied, 1);
  EXPECT_EQ(dut.Result().last_trail, 1);

  scene.static_map_W.Set(KeyAt(0.45, 0.05, 0.05), -5000);
  dut.Add(SeenAt(3.1), scene);
  EXPECT_EQ(dut.Result().last_trail, 0);
  EXPECT_EQ(dut.Result().most_trail, 1);
  EXPECT_NEAR(dut.Result().MeanTrail(), 1 / 3.0, 1e-12);
}

TEST(UnlabelledScore, TellsDynamicSpaceByWhereItIs) {
  UnlabelledScore dut(Moving(), {3});
  SceneSnapshot scene = SceneAt(0);
  dut.Add(SeenAt(0), scene);
  scene.stamp = testing_support::At(3);
  std::vector<DynamicVoxel> dynamic;
  // Where it was, where it is, and elsewhere.
  for (const VoxelKey key :
       {KeyAt(0.45, 0.05, 0.05), KeyAt(3.45, 0.05, 0.05), KeyAt(0.05, -6, 0.05)}) {
    scene.static_map_W.Set(key, 5000);
    dynamic.push_back({key, scene.stamp, scene.stamp});
  }
  std::ranges::sort(dynamic, ComesBefore, [](const DynamicVoxel& voxel) { return voxel.key; });
  scene.dynamic_W = DynamicSpace(dynamic);
  dut.Add(SeenAt(3), scene);
  EXPECT_EQ(dut.Result().dynamic, 3);
  EXPECT_EQ(dut.Result().dynamic_left, 1);
  EXPECT_EQ(dut.Result().dynamic_elsewhere, 1);
  EXPECT_EQ(dut.Result().trail, 0);
}

}  // namespace
}  // namespace clearway
