// Against SceneAtTime, which places every object at every time.
#include "server/timed_scene.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::Random;
using testing_support::RandomFrames;

void ExpectSame(const PointOccupancy& a, const PointOccupancy& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.fused_log_odds, b.fused_log_odds);
}

TEST(TimedScene, Empty) {
  const SceneSnapshot scene = SceneSnapshot::Empty({});
  TimedScene dut(scene);
  EXPECT_EQ(dut.At({1, 2, 3}, Time()).status, SpaceStatus::kUnknownSpace);
  EXPECT_EQ(dut.At({1e6, 2, 3}, Time()).status, SpaceStatus::kOutOfBounds);
}

TEST(TimedScene, SaysWhatPlacedObjectsSay) {
  ThreadPool pool(1);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.4;
  params.horizon = std::chrono::milliseconds(500);
  SceneBuilder builder(params, {}, pool);
  RandomFrames frames(3);
  Random random(4);
  int by_objects = 0, beyond = 0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(builder.Apply(frames.Next()).ok());
    const ScenePtr scene = builder.Publish();
    TimedScene dut(*scene);
    for (int k = 0; k < 400; ++k) {
      // Before and after the newest stamp; every other time comes again.
      const Time time =
          scene->stamp + FromSeconds(k % 2 == 0 ? random.Uniform(-1, 2) : k % 7 * 0.2);
      const Eigen::Vector3d p_W = random.Vector(9);
      const PointOccupancy truth = SceneAtTime(*scene, time).At(p_W);
      ExpectSame(dut.At(p_W, time), truth);
      by_objects += truth.object != kStaticLabel;
      beyond += truth.status == SpaceStatus::kBeyondHorizon;
    }
  }
  EXPECT_GT(by_objects, 100);
  EXPECT_GT(beyond, 100);
}

TEST(TimedScene, ForgetsOldTimes) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  RandomFrames frames(3);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(builder.Apply(frames.Next()).ok());
  const ScenePtr scene = builder.Publish();
  TimedScene dut(*scene);
  for (int i = 0; i < 1000; ++i) {
    const Time time = scene->stamp + std::chrono::milliseconds(i % 600);
    const SceneAtTime truth(*scene, time);
    ASSERT_EQ(dut.Placed(time).objects().size(), truth.objects().size());
    EXPECT_EQ(dut.Placed(time).time(), time);
  }
}

}  // namespace
}  // namespace clearway
