#include "clearway/report/object_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "clearway/sim/simulation.h"
#include "report/test_scene.h"

namespace clearway {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A cube of 1 m at the origin.
std::shared_ptr<const World> OneCube() {
  auto world = std::make_shared<World>();
  world->Add(Body::Single(7, "cube", Box{{1, 1, 1}}, FixedPose{Pose{}}));
  return world;
}

// Its map, of these voxels of 0.1 m; O lies off B.
SceneSnapshot SceneWith(const std::vector<VoxelKey>& voxels_O, Time first_seen, Time stamp) {
  SceneSnapshot scene = SceneSnapshot::Empty({});
  scene.stamp = stamp;
  VoxelMap map_O(0.1);
  for (const VoxelKey& key : voxels_O) map_O.Set(key, 1000);
  MovingObject object;
  object.id = 7;
  object.history = {{stamp, Pose::Translation(0.5, 0, 0)}};
  object.first_seen = first_seen;
  object.last_seen = stamp;
  scene.objects = {std::make_shared<const MovingObject>(WithMap(object, map_O))};
  return scene;
}

Frame FrameOf(const std::vector<Eigen::Vector3f>& points_S, Time stamp) {
  Frame frame;
  frame.stamp = stamp;
  frame.points_S = points_S;
  frame.labels.assign(points_S.size(), 7);
  return frame;
}

const Time kFirst(std::chrono::seconds(1)), kSecond(std::chrono::seconds(2));

TEST(ObjectFit, OfASceneIsOfAllVoxelsAndTellsTheWorst) {
  ObjectFit large, small;
  large.voxel_m = small.voxel_m = 0.1;
  large.errors_m = {0.01, 0.02, 0.05};
  small.errors_m = {0.03, 0.04};
  large.met = large.covered = 30;
  small.met = 10;
  small.covered = 6;
  const SceneFit dut = Together({{1, large}, {2, small}});
  EXPECT_THAT(dut.together.errors_m, ElementsAre(0.01, 0.02, 0.03, 0.04, 0.05));
  EXPECT_EQ(dut.together.Accuracy_m(), 0.03);
  EXPECT_EQ(dut.together.Completeness(), 0.9);
  EXPECT_NEAR(dut.worst_accuracy_voxels, 0.4, 1e-9);
  EXPECT_EQ(dut.worst_completeness, 0.6);
  EXPECT_TRUE(std::isnan(Together({}).together.Completeness()));
}

class ObjectFitterTest : public ::testing::Test {
 protected:
  void Add(const Frame& frame, const Pose& T_W_S, const SceneSnapshot& scene) {
    met_.Add(frame, T_W_S, scene);
    dut_.Add(scene, Pose{});
  }
  std::map<ObjectId, ObjectFit> Fits() const { return dut_.Fits(met_); }

  MetSurfaces met_{OneCube()};
  ObjectFitter dut_{OneCube()};
};

TEST_F(ObjectFitterTest, MeasuresFromTheMiddleOfVoxelsToTheSurface) {
  // B's x is O's + 0.5: these lie 0.05 m in, 0.35 m in and 0.25 m out.
  Add(FrameOf({}, kFirst), Pose{}, SceneWith({{-1, 0, 0}, {-4, 0, 0}, {2, 0, 0}}, kFirst, kFirst));
  const ObjectFit fit = Fits().at(7);
  EXPECT_THAT(fit.errors_m,
              ElementsAre(DoubleNear(0.05, 1e-9), DoubleNear(0.25, 1e-9), DoubleNear(0.35, 1e-9)));
  EXPECT_NEAR(fit.Accuracy_m(), 0.25, 1e-9);
  EXPECT_TRUE(std::isnan(fit.Completeness()));
  EXPECT_THAT(fit.growth, ElementsAre(3));
}

TEST_F(ObjectFitterTest, WhatTheSourceGetsWrongAboutTheSensorIsNoFaultOfTheMap) {
  // A sensor that is told to be 0.4 m farther along x shows the cube, and O, farther by as much.
  SceneSnapshot scene = SceneWith({{-1, 0, 0}}, kFirst, kFirst);
  MovingObject moved = *scene.objects[0];
  moved.history[0].T_W_O.translation.x() += 0.4;
  scene.objects = {std::make_shared<const MovingObject>(moved)};
  dut_.Add(scene, Pose::Translation(0.4, 0, 0));
  EXPECT_THAT(Fits().at(7).errors_m, ElementsAre(DoubleNear(0.05, 1e-9)));
}

TEST_F(ObjectFitterTest, TellsHowMuchOfWhatRaysMetHasVoxels) {
  // Of the sensor at x = -3: on the face towards it, two points in one voxel; on another face.
  const Frame frame =
      FrameOf({{2.5, 0.01, 0.01}, {2.5, 0.02, 0.02}, {2.5, 0.3, 0.3}, {3, 0, 0.5}}, kFirst);
  Add(frame, Pose::Translation(-3, 0, 0), SceneWith({{-10, 0, 0}, {-10, 3, 2}}, kFirst, kFirst));
  const ObjectFit fit = Fits().at(7);
  EXPECT_EQ(fit.met, 3u);
  EXPECT_EQ(fit.covered, 2u);
}

TEST_F(ObjectFitterTest, AMapThatIsBegunAnewCountsFromThere) {
  Add(FrameOf({{0.5, 0.3, 0}}, kFirst), Pose{}, SceneWith({{0, 3, 0}}, kFirst, kFirst));
  Add(FrameOf({{0.5, 0, 0}}, kSecond), Pose{}, SceneWith({{0, 0, 0}}, kSecond, kSecond));
  const ObjectFit fit = Fits().at(7);
  EXPECT_EQ(fit.met, 1u);
  EXPECT_EQ(fit.Completeness(), 1);
  EXPECT_THAT(fit.growth, ElementsAre(1));
}

TEST(ObjectFitter, WithoutATruthThereIsNoFit) {
  const auto nothing = std::make_shared<const World>();
  ObjectFitter dut(nothing);
  dut.Add(SceneWith({{0, 3, 0}}, kFirst, kFirst), Pose{});
  EXPECT_THAT(dut.Fits(MetSurfaces(nothing)), IsEmpty());
}

// Told exactly, everything that rays met is in the map, and nothing else.
TEST(ObjectFitter, OfAnExactSimulationIsGood) {
  const Simulation simulation(*MakeScenario("small"));
  SceneParams params;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  const auto world = std::make_shared<const World>(simulation.world());
  MetSurfaces met(world);
  ObjectFitter dut(world);
  for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
    const Frame frame = simulation.MakeFrame(k);
    ASSERT_TRUE(builder.Apply(frame).ok());
    const ScenePtr scene = builder.Publish();
    met.Add(frame, simulation.TrueT_W_S(k), *scene);
    dut.Add(*scene, Pose{});
  }
  const auto fits = dut.Fits(met);
  EXPECT_GE(fits.size(), 2u);
  for (const auto& [id, fit] : fits) {
    EXPECT_LT(fit.Accuracy_m(), 0.05) << id;
    EXPECT_LE(fit.Quantile_m(1), 0.5 * std::sqrt(3.0) * 0.1 + 1e-3) << id;
    EXPECT_EQ(fit.Completeness(), 1) << id;
  }
}

// Views that are registered to the objects' maps make sharper ones, if the source's poses are off.
TEST(ObjectFitter, OfNoisyPosesIsBetterWithRegisteredViews) {
  ScenarioOptions options;
  options.noise = SlamNoise::TableOne();
  const Simulation simulation(*MakeScenario("crossing", options));
  const auto accuracy_m = [&](double error_m, double error_rad) {
    SceneParams params;
    params.object_pose_error_m = error_m;
    params.object_pose_error_rad = error_rad;
    ThreadPool pool(1);
    SceneBuilder builder(params, {}, pool);
    const auto world = std::make_shared<const World>(simulation.world());
    ObjectFitter dut(world);
    for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
      const Frame frame = simulation.MakeFrame(k);
      EXPECT_TRUE(builder.Apply(frame).ok());
      dut.Add(*builder.Publish(), frame.T_W_S * Inverse(simulation.TrueT_W_S(k)));
    }
    double sum_m = 0;
    for (const auto& [id, fit] : dut.Fits(MetSurfaces(world))) sum_m += fit.Accuracy_m();
    return sum_m;
  };
  EXPECT_LT(accuracy_m(0.57, 0.05), 0.4 * accuracy_m(0, 0));
}

}  // namespace
}  // namespace clearway
