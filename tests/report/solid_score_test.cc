#include "clearway/report/solid_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/test_scene.h"

namespace clearway {
namespace {

using std::chrono::seconds;

// Goes 1 m/s along x, a box of 2 x 1 x 1 m; in the test scene it is object 7, at (-2, 0, 0).
std::shared_ptr<const World> OneBox() {
  auto world = std::make_shared<World>();
  world->Add(Body::Single(
      7, "box", Box{{2, 1, 1}},
      ConstantTwist{Pose::Translation(-2, 0, 0), Twist{.linear = {1, 0, 0}}, TestScene().stamp}));
  return world;
}

SceneSnapshot SceneWith(double speed_mps) {
  SceneSnapshot scene = TestScene();
  auto object = BoxObject(7, {2, 1, 1}, Pose::Translation(-2, 0, 0), scene.stamp);
  object->velocity_O = Twist{.linear = {speed_mps, 0, 0}};
  scene.objects = {object};
  return scene;
}

// All corners of the box.
MetSurfaces AllOfIt() {
  Frame frame;
  frame.stamp = TestScene().stamp;
  for (const float x : {-0.999f, 0.999f}) {
    for (const float y : {-0.499f, 0.499f}) {
      for (const float z : {-0.499f, 0.499f}) frame.points_S.push_back({x, y, z});
    }
  }
  frame.labels.assign(frame.points_S.size(), 7);
  MetSurfaces met(OneBox());
  met.Add(frame, Pose::Translation(-2, 0, 0), TestScene());
  return met;
}

SolidOverlap AfterASecond(double speed_mps) {
  SolidScore dut(OneBox(), TestScene().stamp + seconds(5), {seconds(1)});
  dut.Add(SceneWith(speed_mps), AllOfIt());
  return dut.overlaps().at(7)[0];
}

TEST(SolidScore, OfTheRightPredictionIsOne) {
  const SolidOverlap dut = AfterASecond(1);
  EXPECT_EQ(dut.predicted, 20 * 10 * 10);
  EXPECT_EQ(dut.seen, 20 * 10 * 10);
  EXPECT_EQ(dut.FScore(), 1);
  EXPECT_EQ(dut.WholeFScore(), 1);
}

TEST(SolidScore, AVoxelIsTolerated) {
  EXPECT_EQ(AfterASecond(1.1).FScore(), 1);
  // Five off: four of twenty layers have no voxel beside them in the other.
  EXPECT_NEAR(AfterASecond(1.5).Precision(), 16.0 / 20, 1e-9);
  EXPECT_NEAR(AfterASecond(1.5).Recall(), 16.0 / 20, 1e-9);
  EXPECT_NEAR(AfterASecond(1.5).FScore(), 16.0 / 20, 1e-9);
  EXPECT_EQ(AfterASecond(9).Recall(), 0);
}

TEST(SolidScore, HalfOfAnObjectIsRightButNotAll) {
  SceneSnapshot scene = TestScene();
  scene.objects = {BoxObject(7, {1, 1, 1}, Pose::Translation(-2, 0, 0), scene.stamp)};
  SolidScore dut(OneBox(), scene.stamp, {seconds(0), seconds(1)});
  dut.Add(scene, AllOfIt());
  const auto& overlaps = dut.overlaps().at(7);
  EXPECT_EQ(overlaps[0].Precision(), 1);
  EXPECT_NEAR(overlaps[0].Recall(), 12.0 / 20, 1e-9);
  EXPECT_TRUE(std::isnan(overlaps[1].Recall())) << "beyond the end";
}

// Boxes of recordings may jump: what lies between the two solids costs nothing.
TEST(SolidScore, FarFromTheTruthNothingIsRight) {
  const SolidOverlap dut = AfterASecond(5'000);
  EXPECT_EQ(dut.predicted, 20 * 10 * 10);
  EXPECT_EQ(dut.seen, 20 * 10 * 10);
  EXPECT_EQ(dut.predicted_right, 0);
  EXPECT_EQ(dut.seen_found, 0);
}

TEST(SolidScore, ASolidTooLargeToCompareIsLeftOut) {
  SceneSnapshot scene = TestScene();
  auto object = BoxObject(7, {1, 1, 1}, Pose::Translation(-2, 0, 0), scene.stamp);
  for (const double end_m : {-200.0, 200.0}) {
    object->map_O.Set(object->map_O.grid().KeyOf({end_m, end_m, end_m}),
                      object->map_O.model().clamp_max);
  }
  object->solid = SolidOf(object->map_O);
  scene.objects = {object};
  SolidScore dut(OneBox(), scene.stamp, {seconds(0)});
  dut.Add(scene, AllOfIt());
  EXPECT_EQ(dut.overlaps().at(7)[0].predicted, 0);
  EXPECT_EQ(dut.overlaps().at(7)[0].seen, 0);
}

// Whatever its label: the hull of what was met would reach as far.
TEST(MetSurfaces, WhatIsFarFromTheBodyIsNotOfIt) {
  Frame frame;
  frame.stamp = TestScene().stamp;
  frame.points_S = {{-0.999f, 0, 0}, {-1.4f, 0, 0}, {-1.6f, 0, 0}, {40, 0, 0}};
  frame.labels.assign(frame.points_S.size(), 7);
  MetSurfaces dut(OneBox());
  dut.Add(frame, Pose::Translation(-2, 0, 0), TestScene());
  EXPECT_EQ(dut.Of(7).size(), 2u);
}

// A part that no ray has met is not missed.
TEST(SolidScore, WhatWasNotSeenDoesNotCount) {
  MetSurfaces met(OneBox());
  Frame frame;
  frame.stamp = TestScene().stamp;
  frame.points_S = {{-0.999f, 0, 0}, {-0.999f, 0.499f, 0.499f}};
  frame.labels = {7, 7};
  met.Add(frame, Pose::Translation(-2, 0, 0), TestScene());
  SceneSnapshot scene = TestScene();
  scene.objects = {BoxObject(7, {1, 1, 1}, Pose::Translation(-2.5, 0, 0), scene.stamp)};
  SolidScore dut(OneBox(), scene.stamp, {seconds(0)});
  dut.Add(scene, met);
  EXPECT_GT(dut.overlaps().at(7)[0].seen, 0);
  EXPECT_EQ(dut.overlaps().at(7)[0].FScore(), 1);
  // But it does in the whole solid, of which half and a layer were found.
  EXPECT_EQ(dut.overlaps().at(7)[0].whole, 20 * 10 * 10);
  EXPECT_NEAR(dut.overlaps().at(7)[0].WholeRecall(), 11.0 / 20, 1e-9);
  EXPECT_NEAR(dut.overlaps().at(7)[0].WholeFScore(), 22.0 / 31, 1e-9);
}

// Two halves that a scene takes for one object are judged by both.
TEST(SolidScore, PartsThatTheSceneDoesNotKnowCountWithTheirWhole) {
  const Body front =
      Body::Single(7, "front", Box{{1, 1, 1}}, FixedPose{Pose::Translation(-1.5, 0, 0)});
  Body back = Body::Single(8, "back", Box{{1, 1, 1}}, FixedPose{Pose::Translation(-2.5, 0, 0)});
  back.part_of = 7;
  const auto world = std::make_shared<const World>(std::vector<Body>{front, back});
  MetSurfaces met(world);
  Frame frame;
  frame.stamp = TestScene().stamp;
  for (const ObjectId id : {7, 8}) {
    for (const float x : {-0.499f, 0.499f}) {
      for (const float y : {-0.499f, 0.499f}) {
        for (const float z : {-0.499f, 0.499f}) {
          frame.points_S.push_back({x + (id == 7 ? -1.5f : -2.5f), y, z});
          frame.labels.push_back(id);
        }
      }
    }
  }
  met.Add(frame, Pose(), TestScene());
  SceneSnapshot scene = SceneWith(0);
  SolidScore dut(world, scene.stamp, {seconds(0)});
  dut.Add(scene, met);
  EXPECT_EQ(dut.overlaps().at(7)[0].seen, 20 * 10 * 10);
  EXPECT_EQ(dut.overlaps().at(7)[0].FScore(), 1);
  scene.objects.push_back(BoxObject(8, {1, 1, 1}, Pose::Translation(-2.5, 0, 0), scene.stamp));
  SolidScore apart(world, scene.stamp, {seconds(0)});
  apart.Add(scene, met);
  EXPECT_EQ(apart.overlaps().at(7)[0].seen, 10 * 10 * 10);
  EXPECT_LT(apart.overlaps().at(7)[0].Precision(), 1);
}

TEST(SolidScore, OnlyWhatIsSeenAndTrueCounts) {
  SceneSnapshot scene = SceneWith(1);
  scene.stamp += seconds(1);
  SolidScore dut(OneBox(), scene.stamp, {seconds(0)});
  dut.Add(scene, AllOfIt());
  scene = TestScene();
  scene.objects = {BoxObject(8, {1, 1, 1}, {}, scene.stamp)};
  dut.Add(scene, AllOfIt());
  EXPECT_TRUE(dut.overlaps().empty());
}

}  // namespace
}  // namespace clearway
