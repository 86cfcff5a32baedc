#include "scene/point_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// A thing of 1 x 1 x 1 m, first at (5, 0, 0.5), that goes along x at 1 m/s.
class PointPlacement : public testing::Test {
 protected:
  explicit PointPlacement() {
    SceneParams params;
    params.motion_from_points = MotionFromPoints::kOff;
    dut_.emplace(params, FrameLimits{}, pool_);
  }
  static Frame Showing(double seconds, const Eigen::Vector3d& center_W) {
    Frame frame = FrameAt(seconds);
    AddObject(frame, 5, Pose::Translation(center_W.x(), center_W.y(), center_W.z()),
              BoxSurface({1, 1, 1}, 0.1));
    return frame;
  }
  FrameReport Applied(const Frame& frame) {
    const auto report = dut_->Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    return report.ok() ? *report : FrameReport();
  }
  // Six frames with motions, the last at 0.5 s.
  void ShowFirst() {
    for (int k = 0; k < 6; ++k) {
      Frame frame = Showing(0.1 * k, {5 + 0.1 * k, 0, 0.5});
      if (k > 0) frame.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0.1 * (k - 1))});
      Applied(frame);
    }
  }
  const MovingObject& Object() {
    scene_ = dut_->Publish();
    return *scene_->FindObject(5);
  }
  Eigen::Vector3d Center() {
    const MovingObject& object = Object();
    return object.history.back().T_W_O * object.solid->box_O.Center();
  }
  ThreadPool pool_{1};
  std::optional<SceneBuilder> dut_;
  ScenePtr scene_;
};

TEST_F(PointPlacement, PointsWhereItIsPredictedAreItsOwn) {
  ShowFirst();
  const FrameReport report = Applied(Showing(0.6, {5.6, 0, 0.5}));
  EXPECT_EQ(report.objects_bridged, 1u);
  EXPECT_EQ(report.objects_restarted, 0u);
  EXPECT_TRUE(Object().bridged);
  EXPECT_EQ(Object().pose_source(), PoseSource::kBridged);
  EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25);
}

// After a gap it is 3 m aside, 22 m away, or in its own way.
TEST_F(PointPlacement, PointsElsewhereBeginANewModelOfTheSameId) {
  for (const Eigen::Vector3d& there_W : {Eigen::Vector3d(6.6, 3, 0.5),
                                         {6.6, -3, 0.5},
                                         {28.6, 0, 0.5},
                                         {8.6, 0, 0.5},
                                         {3.6, 0, 0.5}}) {
    dut_->Reset();
    ShowFirst();
    const FrameReport report = Applied(Showing(1.6, there_W));
    EXPECT_EQ(report.objects_restarted, 1u);
    EXPECT_EQ(report.objects_dropped, 1u);
    EXPECT_EQ(report.objects_created, 1u);
    ASSERT_EQ(report.issues.size(), 1u);
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kRestarted);
    EXPECT_EQ(report.issues[0].id, 5);
    EXPECT_NEAR(report.issues[0].value, (there_W - Eigen::Vector3d(6.6, 0, 0.5)).norm(), 0.25);
    EXPECT_LT(report.issues[0].limit, 1.5);
    EXPECT_LT((Center() - there_W).norm(), 0.1);
    EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25);
    EXPECT_EQ(Object().first_seen, At(1.6));

    // It goes on from there.
    Frame next = Showing(1.7, there_W + Eigen::Vector3d(0.1, 0, 0));
    next.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(1.6)});
    EXPECT_EQ(Applied(next).objects_restarted, 0u);
    EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25);
    EXPECT_NEAR(Object().SpeedMps(), 1, 1e-6);
  }
}

// A motion that starts where nobody saw the object starts from a prediction.
TEST_F(PointPlacement, SoDoPointsElsewhereWithAMotionFromWithinTheGap) {
  ShowFirst();
  Frame frame = Showing(1.6, {6.6, 3, 0.5});
  frame.motions.push_back({5, Pose::Translation(0, 0.1, 0), At(1.5)});
  const FrameReport report = Applied(frame);
  EXPECT_EQ(report.objects_restarted, 1u);
  EXPECT_LT((Center() - Eigen::Vector3d(6.6, 3, 0.5)).norm(), 0.1);
  EXPECT_NEAR(Object().SpeedMps(), 1, 1e-6);
}

TEST_F(PointPlacement, AMotionOverTheGapNeedsNoPrediction) {
  ShowFirst();
  Frame frame = Showing(1.6, {6.6, 3, 0.5});
  frame.motions.push_back({5, Pose::Translation(1.1, 3, 0), At(0.5)});
  EXPECT_EQ(Applied(frame).objects_restarted, 0u);
  EXPECT_LT((Center() - Eigen::Vector3d(6.6, 3, 0.5)).norm(), 0.1);
  EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25);
  EXPECT_EQ(Object().first_seen, At(0));
}

// Begun anew at 1.6 s, and then its source gives the motion over the gap.
TEST_F(PointPlacement, AMotionFromBeforeTheModelIsOneOfItsVelocity) {
  ShowFirst();
  Applied(Showing(1.6, {6.6, 3, 0.5}));
  Frame frame = Showing(1.7, {6.7, 3, 0.5});
  frame.motions.push_back({5, Pose::Translation(1.2, 3, 0), At(0.5)});
  EXPECT_EQ(Applied(frame).objects_restarted, 0u);
  EXPECT_LT((Center() - Eigen::Vector3d(6.7, 3, 0.5)).norm(), 0.2);
  EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.35);
}

TEST_F(PointPlacement, WhereTheOldModelWouldBeIsUnknown) {
  ShowFirst();
  Frame frame = Showing(1.6, {6.6, 30, 0.5});
  Applied(frame);
  EXPECT_EQ(scene_ = dut_->Publish(), scene_);
  const auto& map_W = scene_->static_map_W;
  EXPECT_EQ(map_W.State(map_W.grid().KeyOf({5.5, 0.05, 0.55})), VoxelState::kUnknown);
}

// Half a metre off: the prediction may be that wrong. The points say where it is.
TEST_F(PointPlacement, PointsWithinTheBoundMoveThePrediction) {
  ShowFirst();
  const FrameReport report = Applied(Showing(1.6, {6.6, 0.5, 0.5}));
  EXPECT_EQ(report.objects_restarted, 0u);
  EXPECT_LT((Center() - Eigen::Vector3d(6.6, 0.5, 0.5)).norm(), 0.2);
  EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.35);
}

// Each frame it is a little farther from where it is predicted than in the one before.
TEST_F(PointPlacement, ABridgedModelDoesNotGrowFrameByFrame) {
  for (const double aside_m : {0.05, 0.1, 0.15, 0.19, 0.25}) {
    dut_->Reset();
    ShowFirst();
    Eigen::Vector3d center_W(5.5, 0, 0.5);
    for (int k = 1; k <= 40; ++k) {
      center_W += Eigen::Vector3d(0.1, aside_m, 0);
      EXPECT_EQ(Applied(Showing(0.5 + 0.1 * k, center_W)).objects_restarted, 0u);
    }
    EXPECT_TRUE(Object().bridged);
    EXPECT_LT((Center() - center_W).norm(), 0.2) << aside_m;
    EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.35) << aside_m;
  }
}

// Half of it, then the other half, then all of it.
TEST_F(PointPlacement, ABridgedModelGrowsByViewsOfMoreOfIt) {
  ShowFirst();
  for (int k = 6; k < 30; ++k) {
    Frame frame = FrameAt(0.1 * k);
    const double length_m = std::min(4.0, 1 + 0.2 * (k - 5));
    AddObject(frame, 5, Pose::Translation(5 + 0.1 * k + length_m / 2 - 0.5, 0, 0.5),
              BoxSurface({length_m, 1, 1}, 0.1));
    EXPECT_EQ(Applied(frame).objects_restarted, 0u);
  }
  EXPECT_NEAR(Object().solid->box_O.Size().x(), 4, 0.25);
  EXPECT_LT((Center() - Eigen::Vector3d(9.4, 0, 0.5)).norm(), 0.3);
}

// A view of more of it widens its model.
TEST_F(PointPlacement, ALargerViewIsNoOtherObject) {
  ShowFirst();
  Frame frame = FrameAt(0.6);
  AddObject(frame, 5, Pose::Translation(5.6, 0.5, 0.5), BoxSurface({1, 2, 1}, 0.1));
  EXPECT_EQ(Applied(frame).objects_restarted, 0u);
  EXPECT_NEAR(Object().solid->box_O.Size().y(), 2, 0.25);
}

// Its tracker knows it from the second sighting on: the pose says where B is, the points where the
// object has gone since the first.
TEST_F(PointPlacement, TheFirstPoseOfAnObjectThatIsKnownByItsPoints) {
  for (const auto from_points : {MotionFromPoints::kOff, MotionFromPoints::kAuto}) {
    for (const double step_m : {0.0, 0.1, 0.5, 1.5, 3.0}) {
      SceneParams params;
      params.motion_from_points = from_points;
      dut_.emplace(params, FrameLimits{}, pool_);
      for (int k = 0; k < 8; ++k) {
        const Eigen::Vector3d center_W(5 + step_m * k, 2, 0.5);
        Frame frame = Showing(0.1 * k, center_W);
        if (k > 0) frame.poses.push_back({5, Pose::Translation(center_W.x(), 2, 0)});
        Applied(frame);
      }
      EXPECT_LT((Center() - Eigen::Vector3d(5 + 7 * step_m, 2, 0.5)).norm(), 0.15) << step_m;
      EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25) << step_m;
      EXPECT_NEAR(Object().SpeedMps(), 10 * step_m, 0.01) << step_m;
    }
  }
}

// Seen once, and then by its tracker, 22 m away.
TEST_F(PointPlacement, TheFirstPoseAfterAGap) {
  for (const double y_m : {0.0, 10.0}) {
    dut_->Reset();
    Applied(Showing(0, {5, 0, 0.5}));
    for (int k = 11; k < 16; ++k) {
      Frame frame = Showing(0.1 * k, {5 + 2.0 * k, y_m, 0.5});
      frame.poses.push_back({5, Pose::Translation(5 + 2.0 * k, y_m, 0)});
      Applied(frame);
    }
    EXPECT_LT((Center() - Eigen::Vector3d(35, y_m, 0.5)).norm(), 0.15);
    EXPECT_LT(Object().solid->box_O.Size().maxCoeff(), 1.25);
  }
}

TEST_F(PointPlacement, AnotherFrameOfTheSameStampIsNotGated) {
  ShowFirst();
  Frame other = Showing(0.5, {5.5, 0.8, 0.5});
  other.sensor_id = "second";
  const FrameReport report = Applied(other);
  EXPECT_EQ(report.objects_restarted + report.objects_bridged, 0u);
}

}  // namespace
}  // namespace clearway
