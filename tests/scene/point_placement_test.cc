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

// A view of more of it widens its model.
TEST_F(PointPlacement, ALargerViewIsNoOtherObject) {
  ShowFirst();
  Frame frame = FrameAt(0.6);
  AddObject(frame, 5, Pose::Translation(5.6, 0.5, 0.5), BoxSurface({1, 2, 1}, 0.1));
  EXPECT_EQ(Applied(frame).objects_restarted, 0u);
  EXPECT_NEAR(Object().solid->box_O.Size().y(), 2, 0.25);
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
