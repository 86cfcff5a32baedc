#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "soak/looped_frames.h"
#include "soak/memory_trend.h"
#include "support/frames.h"

namespace clearway::soak {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;

TEST(MemoryTrend, Empty) {
  EXPECT_EQ(GrowthPerHour({}), 0);
  EXPECT_EQ(GrowthPerHour({{1, 100}}), 0);
  EXPECT_EQ(GrowthPerHour({{1, 100}, {1, 200}}), 0);
}

TEST(MemoryTrend, OfALineIsItsSlope) {
  std::vector<MemorySample> samples;
  for (int s = 0; s < 100; ++s) samples.push_back({600.0 + s, 1'000'000'000u + 50u * s});
  EXPECT_NEAR(GrowthPerHour(samples), 180'000, 1e-3);
  for (int s = 0; s < 100; ++s) samples[s].bytes = 1'000'000'000u - 50u * s;
  EXPECT_NEAR(GrowthPerHour(samples), -180'000, 1e-3);
}

std::vector<Frame> ThreeFrames() {
  std::vector<Frame> frames;
  for (int k = 0; k < 3; ++k) {
    frames.push_back(FrameAt(1 + 0.1 * k));
    AddPoint(frames.back(), kStaticLabel, {5, 0, 0});
    AddPoint(frames.back(), 7, {3, 0, 0});
    frames.back().motions = {
        {7, Pose::Translation(0.1, 0, 0), frames.back().stamp - FromSeconds(0.1)}};
  }
  return frames;
}

TEST(LoopedFrames, GoOnWithNewIds) {
  LoopedFrames dut(ThreeFrames(), FromSeconds(0.1));
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, {}, pool);
  std::set<ObjectId> ids;
  for (int k = 0; k < 9; ++k) {
    const Frame frame = dut.Next();
    EXPECT_EQ(frame.stamp, Time() + FromSeconds(1) + k * FromSeconds(0.1));
    EXPECT_EQ(frame.labels[0], kStaticLabel);
    EXPECT_EQ(frame.motions.empty(), k % 3 == 0);
    if (k % 3 != 0) {
      EXPECT_EQ(frame.motions[0].id, frame.labels[1]);
    }
    ids.insert(frame.labels[1]);
    EXPECT_TRUE(builder.Apply(frame).ok()) << k;
  }
  EXPECT_EQ(ids.size(), 3u);
  EXPECT_EQ(ids.count(BridgedObject::kId), 0u);
}

TEST(BridgedObject, IsWhereItIsPredictedWithoutMotions) {
  BridgedObject dut({0, 0, 6});
  ThreadPool pool(1);
  SceneParams params;
  params.motion_from_points = MotionFromPoints::kOff;
  SceneBuilder builder(params, {}, pool);
  for (int k = 0; k < 200; ++k) {
    const Frame frame = dut.At(Time() + k * FromSeconds(0.1));
    EXPECT_EQ(frame.motions.empty(), k == 0 || k >= 5);
    ASSERT_TRUE(builder.Apply(frame).ok()) << k;
  }
  const ScenePtr scene = builder.Publish();
  const MovingObject* object = scene->FindObject(BridgedObject::kId);
  ASSERT_NE(object, nullptr);
  EXPECT_TRUE(object->bridged);
  EXPECT_LT(object->observed_box_O.Size().maxCoeff(), 2) << "the model was smeared";
}

}  // namespace
}  // namespace clearway::soak
