// Whether a frame sees through an object where it is said to be.
#include "scene/ray_evidence.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// A cube of 1 m, 5 m ahead of the sensor.
class RayEvidence : public testing::Test {
 protected:
  RayEvidence() {
    Frame frame = FrameAt(0);
    AddObject(frame, 7, T_W_cube_, BoxSurface({1, 1, 1}, 0.1));
    EXPECT_TRUE(builder_.Apply(frame).ok());
    object_ = *builder_.Publish()->FindObject(7);
  }
  // So many points of a wall across the way, on its middle.
  static void AddWall(double x_m, int points, ObjectId label, Frame& frame) {
    for (int i = 0; i < points; ++i) {
      AddPoint(frame, label, {x_m, 0.1 * (i % 7 - 3), 0.1 * (i / 7 % 7 - 3)});
    }
  }
  bool Passes(const Frame& frame, double x_m = 0) {
    FrameReport report;
    const LabelledCloud cloud = PlaceCloud(frame, {}, report);
    const Pose T_W_O = Pose::Translation(x_m, 0, 0) * object_.history.back().T_W_O;
    const auto hits = cloud.object_hits.find(7);
    const std::span<const std::uint32_t> points =
        hits == cloud.object_hits.end() ? std::span<const std::uint32_t>() : hits->second;
    return IsPassedThrough(object_, T_W_O, points, cloud, {});
  }

  const Pose T_W_cube_ = Pose::Translation(5, 0, 0);
  ThreadPool pool_{1};
  SceneBuilder builder_{SceneParams{}, FrameLimits{}, pool_};
  MovingObject object_;
};

TEST_F(RayEvidence, RaysThatGoOnSpeakAgainstIt) {
  Frame frame = FrameAt(0.1);
  AddWall(9, 49, kStaticLabel, frame);
  EXPECT_TRUE(Passes(frame));
  EXPECT_FALSE(Passes(frame, 10));  // they end before it
}

TEST_F(RayEvidence, ItsOwnPointsSpeakForIt) {
  Frame frame = FrameAt(0.1);
  AddWall(4.5, 49, 7, frame);
  EXPECT_FALSE(Passes(frame));
  AddWall(9, 49, kStaticLabel, frame);  // through a window
  EXPECT_FALSE(Passes(frame));
}

// Its points may have lost their labels, but not got another object's.
TEST_F(RayEvidence, BackgroundMayBeThereButNoOtherObject) {
  Frame background = FrameAt(0.1), other = FrameAt(0.1);
  AddWall(4.5, 49, kStaticLabel, background);
  EXPECT_FALSE(Passes(background));
  AddWall(4.5, 49, 8, other);
  EXPECT_TRUE(Passes(other));
}

TEST_F(RayEvidence, AFewRaysSayNothing) {
  Frame frame = FrameAt(0.1);
  AddWall(9, 4, kStaticLabel, frame);
  EXPECT_FALSE(Passes(frame));
}

}  // namespace
}  // namespace clearway
