// Hours of points without motions: what is stated of objects stays within limits that mirrors take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

class LongBridging : public testing::Test {
 protected:
  static SceneParams Params(MotionFromPoints from_points) {
    SceneParams params;
    params.motion_from_points = from_points;
    return params;
  }
  // A frame that shows a box at (x, 5, 0).
  static Frame Showing(double seconds, double x_m) {
    Frame frame = FrameAt(seconds);
    AddObject(frame, 5, Pose::Translation(x_m, 5, 0), BoxSurface({1, 1, 1}, 0.1));
    return frame;
  }
  static const MovingObject& ObjectIn(SceneBuilder& dut) { return *dut.Publish()->FindObject(5); }
  // The scene arrives at a mirror that starts from nothing, and at one that has the version before.
  static void ExpectMirrored(const ScenePtr& before, const ScenePtr& now) {
    for (const SceneSnapshot* base : {static_cast<const SceneSnapshot*>(nullptr), before.get()}) {
      const auto mirrored = Apply(base, Diff(base, *now));
      ASSERT_TRUE(mirrored.ok()) << mirrored.status();
      EXPECT_EQ(mirrored->Hash(), now->Hash());
    }
  }
  ThreadPool pool_{1};
};

// It is told to move at 1 m/s, then shown for three hours, once a second, where it stands.
TEST_F(LongBridging, AnObjectShownWithoutMotionsStaysMirrored) {
  for (const auto from_points : {MotionFromPoints::kAuto, MotionFromPoints::kOff}) {
    SceneBuilder dut(Params(from_points), {}, pool_);
    ASSERT_TRUE(dut.Apply(Showing(0, 5)).ok());
    Frame moved = Showing(0.1, 5.1);
    moved.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0)});
    ASSERT_TRUE(dut.Apply(moved).ok());
    ScenePtr before = dut.Publish();
    for (int k = 2; k < 3 * 3'600; ++k) {
      const bool checked = k % 300 == 0;
      // One point is enough to bridge; most frames show no more.
      Frame frame = checked ? Showing(k, 5.1) : FrameAt(k);
      if (!checked) AddPoint(frame, 5, {5.1, 5, 0.5});
      ASSERT_TRUE(dut.Apply(frame).ok()) << k;
      if (!checked) continue;
      const ScenePtr now = dut.Publish();
      ExpectMirrored(before, now);
      before = now;
    }
    const MovingObject& object = ObjectIn(dut);
    EXPECT_LT((object.history.back().T_W_O.translation - Eigen::Vector3d(5.1, 5, 0)).norm(), 1.0);
    EXPECT_LE(object.bound.At(0), kMaxBoundTerm);
  }
}

// A stated bound grows with the square of the time; its terms are cut at one limit.
TEST_F(LongBridging, BoundsAreSaturated) {
  const PositionBound bound = Saturated({2e6, 3e7, 0.5});
  EXPECT_EQ(bound, (PositionBound{kMaxBoundTerm, kMaxBoundTerm, 0.5}));
  EXPECT_EQ(Saturated({1, 2, 3}), (PositionBound{1, 2, 3}));
}

// It goes at 30 m/s towards the edge of what coordinates may be, and is shown where it stops.
TEST_F(LongBridging, PredictionCarriesNothingBeyondTheCoordinateLimit) {
  SceneParams params = Params(MotionFromPoints::kOff);
  SceneBuilder dut(params, {.max_coordinate_m = 100}, pool_);
  ASSERT_TRUE(dut.Apply(Showing(0, 92)).ok());
  Frame moved = Showing(0.1, 95);
  moved.motions.push_back({5, Pose::Translation(3, 0, 0), At(0)});
  ASSERT_TRUE(dut.Apply(moved).ok());
  for (int k = 2; k < 200; ++k) {
    const auto report = dut.Apply(Showing(0.1 * k, std::min(95 + 3.0 * (k - 1), 99.0)));
    ASSERT_TRUE(report.ok()) << k << ": " << report.status();
    const Pose& T_W_O = ObjectIn(dut).history.back().T_W_O;
    ASSERT_LE(T_W_O.translation.cwiseAbs().maxCoeff(), 100) << k;
  }
  EXPECT_NEAR(ObjectIn(dut).history.back().T_W_O.translation.x(), 99, 0.2);
}

// Without points prediction alone goes on; frames of other things are accepted all the same.
TEST_F(LongBridging, AnUnseenObjectRefusesNoFrames) {
  SceneBuilder dut(Params(MotionFromPoints::kAuto), {.max_coordinate_m = 100}, pool_);
  ASSERT_TRUE(dut.Apply(Showing(0, 92)).ok());
  Frame moved = Showing(0.1, 95);
  moved.motions.push_back({5, Pose::Translation(3, 0, 0), At(0)});
  ASSERT_TRUE(dut.Apply(moved).ok());
  for (int k = 2; k < 200; ++k) {
    Frame frame = FrameAt(0.1 * k);
    AddPoint(frame, kStaticLabel, {3, 0, 0});
    ASSERT_TRUE(dut.Apply(frame).ok());
  }
}

// Bridging ends with the horizon: where the object is then is where its points are.
TEST_F(LongBridging, EndsWithTheHorizon) {
  SceneBuilder dut(Params(MotionFromPoints::kOff), {}, pool_);
  ASSERT_TRUE(dut.Apply(Showing(0, 5)).ok());
  Frame moved = Showing(0.1, 5.1);
  moved.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0)});
  ASSERT_TRUE(dut.Apply(moved).ok());
  std::vector<ObjectIssue> issues;
  for (int k = 2; k <= 60; ++k) {
    const auto report = dut.Apply(Showing(0.1 * k, 5 + 0.1 * k));
    ASSERT_TRUE(report.ok());
    issues.insert(issues.end(), report->issues.begin(), report->issues.end());
  }
  ASSERT_EQ(issues.size(), 1u);  // then no motion is known, and there is nothing to extrapolate
  EXPECT_EQ(issues[0].kind, ObjectIssueKind::kBridgedTooLong);
  EXPECT_EQ(issues[0].id, 5);
  EXPECT_NEAR(issues[0].value, 5.1, 0.01);
  EXPECT_EQ(issues[0].limit, 5);
  EXPECT_EQ(ObjectIn(dut).first_seen, At(5.2));
}

}  // namespace
}  // namespace clearway
