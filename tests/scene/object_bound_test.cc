// The bounds of a scene's objects, as frames come.
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "scene/position_bound.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// What comes without a pose is bridged, however long.
SceneParams ByTrack() {
  SceneParams params;
  params.motion = MotionModel::kTrack;
  params.motion_from_points = MotionFromPoints::kOff;
  return params;
}

Pose Steady(double t) { return Pose::Translation(8 * t, 0, 0); }

class BoundOfObject : public testing::Test {
 protected:
  const MovingObject& After(const Frame& frame) {
    EXPECT_TRUE(builder_.Apply(frame).ok());
    scene_ = builder_.Publish();
    return *scene_->FindObject(5);
  }
  static Frame Seen(int k) {
    Frame frame = FrameAt(0.1 * k);
    const Pose T_W_B = Steady(0.1 * k);
    AddObject(frame, 5, T_W_B, BoxSurface({1, 0.6, 0.4}, 0.05));
    frame.poses.push_back({5, T_W_B});
    return frame;
  }

  ThreadPool pool_{1};
  SceneBuilder builder_{ByTrack(), {}, pool_};
  ScenePtr scene_;
};

TEST_F(BoundOfObject, IsStatedFromItsFirstSightOn) {
  EXPECT_GT(After(Seen(0)).bound.At(1), 0.5);
  for (int k = 1; k < 10; ++k) EXPECT_GT(After(Seen(k)).bound.At(1), 0.3);
}

TEST_F(BoundOfObject, GoesOnWhileNoPoseComes) {
  for (int k = 0; k < 10; ++k) After(Seen(k));
  const PositionBound before = scene_->FindObject(5)->bound;
  Frame frame = Seen(14);
  frame.poses.clear();
  const MovingObject& object = After(frame);
  ASSERT_TRUE(object.bridged);
  EXPECT_NEAR(object.bound.At(1), before.At(1.5), 1e-9);
}

// Predictions are no witnesses of how good predictions are.
TEST_F(BoundOfObject, IsThatOfAYoungTrackAfterAGap) {
  for (int k = 0; k < 60; ++k) After(Seen(k));
  const double known_m = scene_->FindObject(5)->bound.At(1);
  for (int k = 60; k < 90; ++k) {
    Frame frame = Seen(k);
    frame.poses.clear();
    After(frame);
  }
  After(Seen(90));
  EXPECT_GT(After(Seen(91)).bound.At(1), 1.5 * known_m);
}

// The same by motions, of which one begins where the object was not seen.
TEST_F(BoundOfObject, IsThatOfAYoungTrackAfterAMotionFromAPrediction) {
  const auto moved = [](int from, int k) {
    Frame frame = Seen(k);
    frame.poses.clear();
    frame.motions.push_back({5, Steady(0.1 * k) * Inverse(Steady(0.1 * from)), At(0.1 * from)});
    return frame;
  };
  After(Seen(0));
  for (int k = 1; k < 60; ++k) After(moved(k - 1, k));
  const double known_m = scene_->FindObject(5)->bound.At(1);
  After(moved(89, 90));
  EXPECT_GT(After(moved(90, 91)).bound.At(1), 1.5 * known_m);
}

TEST_F(BoundOfObject, OfWhatRestsGoesOnWhileNoPoseComes) {
  Frame frame = Seen(0);
  for (int k = 0; k < 20; ++k) {
    frame.stamp = At(0.1 * k);
    After(frame);
  }
  const MovingObject before = *scene_->FindObject(5);
  ASSERT_EQ(before.velocity_O, Twist{});
  frame.poses.clear();
  frame.stamp += std::chrono::seconds(2);
  EXPECT_NEAR(After(frame).bound.At(1), before.bound.At(3), 1e-9);
  // It is never less certain than what was just seen for the first time.
  for (int k = 0; k < 300; ++k) {
    frame.stamp += std::chrono::milliseconds(100);
    EXPECT_LE(After(frame).bound.At(1), BoundModel{}.unknown_mps);
  }
}

// Up to the future's end nothing is uncertain, and behind it, it begins there.
TEST_F(BoundOfObject, CountsFromTheFuturesEndWhenItIsBridged) {
  for (int k = 0; k < 10; ++k) After(Seen(k));
  ASSERT_TRUE(builder_.SetFuture(5, {{At(2), Steady(2)}}).ok());
  const PositionBound before = scene_->FindObject(5)->bound;
  Frame frame = Seen(15);
  frame.poses.clear();
  EXPECT_EQ(After(frame).bound, before);
  frame = Seen(30);
  frame.poses.clear();
  EXPECT_NEAR(After(frame).bound.At(1), before.At(2), 1e-9);
}

TEST_F(BoundOfObject, StaysWhileNoMotionIsEverKnown) {
  SceneParams params = ByTrack();
  params.motion_from_points = MotionFromPoints::kOff;
  SceneBuilder dut(params, {}, pool_);
  Frame frame = Seen(0);
  frame.poses.clear();
  ASSERT_TRUE(dut.Apply(frame).ok());
  const PositionBound first = dut.Publish()->FindObject(5)->bound;
  for (int k = 1; k < 50; ++k) {
    frame.stamp = At(0.1 * k);
    ASSERT_TRUE(dut.Apply(frame).ok());
  }
  EXPECT_EQ(dut.Publish()->FindObject(5)->bound, first);
}

TEST_F(BoundOfObject, BeginsWhereAStatedFutureEnds) {
  for (int k = 0; k < 10; ++k) After(Seen(k));
  ASSERT_TRUE(builder_.SetFuture(5, {{At(2), Pose::Translation(20, 0, 0)}}).ok());
  scene_ = builder_.Publish();
  const MovingObject& object = *scene_->FindObject(5);
  const auto bound_m = [&](double t) {
    return object.bound.At(ToSeconds(At(t) - object.LastPose().stamp));
  };
  EXPECT_EQ(bound_m(1.9), 0);
  EXPECT_EQ(bound_m(3), object.bound.At(1));
  EXPECT_GT(bound_m(3), 0);
}

}  // namespace
}  // namespace clearway
