#include "scene/contradicted_placement.h"

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

// A van of 4 x 2 x 2 m, first at (5, 0, 1), that goes along x at 1 m/s.
class ContradictedPlacement : public testing::Test {
 protected:
  static Frame Showing(double seconds, double x_m) {
    Frame frame = FrameAt(seconds);
    AddObject(frame, 5, Pose::Translation(x_m, 0, 1), BoxSurface({4, 2, 2}, 0.2));
    return frame;
  }
  // What of the box's surface a sensor at the origin sees.
  static std::vector<Eigen::Vector3d> Facing(const Eigen::Vector3d& size_m,
                                             const Eigen::Vector3d& center_W) {
    std::vector<Eigen::Vector3d> points = BoxSurface(size_m, 0.2);
    std::erase_if(points, [&](const Eigen::Vector3d& p) {
      for (int axis = 0; axis < 3; ++axis) {
        const bool on_side = std::abs(p[axis]) > size_m[axis] / 2 - 1e-6;
        if (on_side && p[axis] * (p[axis] + center_W[axis]) < 0) return false;
      }
      return true;
    });
    return points;
  }
  // Across the way, without the rays that its points hide.
  static void AddWall(double x_m, double width_m, Frame& frame) {
    const std::size_t objects = frame.points_S.size();
    for (double y = -width_m / 2; y <= width_m / 2; y += 0.3) {
      for (double z = -1; z <= 5; z += 0.3) {
        const Eigen::Vector3f p = Eigen::Vector3d(x_m, y, z).cast<float>();
        bool is_hidden = false;
        for (std::size_t i = 0; i < objects && !is_hidden; ++i) {
          const Eigen::Vector3f& q = frame.points_S[i];
          is_hidden = (q.normalized() - p.normalized()).norm() < 0.02f;
        }
        if (!is_hidden) AddPoint(frame, kStaticLabel, p.cast<double>());
      }
    }
  }
  FrameReport Applied(const Frame& frame) {
    const auto report = dut_.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    return report.ok() ? *report : FrameReport();
  }
  // Six frames with motions, or with poses, the last at 0.5 s.
  void ShowMoving(bool with_poses) {
    for (int k = 0; k < 6; ++k) {
      Frame frame = Showing(0.1 * k, 5 + 0.1 * k);
      if (with_poses) {
        frame.poses.push_back({5, Pose::Translation(5 + 0.1 * k, 0, 1)});
      } else if (k > 0) {
        frame.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0.1 * (k - 1))});
      }
      EXPECT_TRUE(Applied(frame).issues.empty());
    }
  }
  MovingObject Object() { return *dut_.Publish()->FindObject(5); }
  double Length() { return Object().solid->box_O.Size().x(); }
  double CenterX() {
    const MovingObject object = Object();
    return (object.history.back().T_W_O * object.solid->box_O.Center()).x();
  }

  ThreadPool pool_{1};
  SceneBuilder dut_{SceneParams{}, FrameLimits{}, pool_};
};

TEST_F(ContradictedPlacement, AWrongMotionIsLeftOutAndNamed) {
  for (const double wrong_m : {4.0, -6.0, 40.0, 90.0}) {
    dut_.Reset();
    ShowMoving(false);
    Frame frame = Showing(0.6, 5.6);
    frame.motions.push_back({5, Pose::Translation(wrong_m, 0, 0), At(0.5)});
    const FrameReport report = Applied(frame);
    EXPECT_EQ(report.motions_implausible, 1u) << wrong_m;
    ASSERT_EQ(report.issues.size(), 1u) << wrong_m;
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kContradicted);
    EXPECT_EQ(report.issues[0].id, 5);
    EXPECT_NEAR(report.issues[0].value, std::abs(wrong_m - 0.1), 0.3);
    EXPECT_LT(report.issues[0].limit, 3.1);
    EXPECT_LT(Length(), 4.5) << wrong_m;
    EXPECT_NEAR(CenterX(), 5.6, 0.2) << wrong_m;
  }
}

// Less than the van's size, but where it was predicted the points fit.
TEST_F(ContradictedPlacement, SoIsOneThatIsALittleWrong) {
  for (const double wrong_m : {1.0, -0.8, 1.6}) {
    dut_.Reset();
    ShowMoving(false);
    const double length_m = Length();
    Frame frame = Showing(0.6, 5.6);
    frame.motions.push_back({5, Pose::Translation(0.1 + wrong_m, 0, 0), At(0.5)});
    const FrameReport report = Applied(frame);
    ASSERT_EQ(report.issues.size(), 1u) << wrong_m;
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kContradicted);
    EXPECT_NEAR(report.issues[0].value, std::abs(wrong_m), 0.15);
    EXPECT_LT(report.issues[0].limit, 0.8);
    EXPECT_NEAR(Length(), length_m, 1e-9) << wrong_m;
    EXPECT_NEAR(CenterX(), 5.6, 0.1) << wrong_m;
  }
}

TEST_F(ContradictedPlacement, SoIsAWrongPoseAndTheNextCounts) {
  ShowMoving(true);
  Frame wrong = Showing(0.6, 5.6);
  wrong.poses.push_back({5, Pose::Translation(77, 0, 1)});
  const FrameReport report = Applied(wrong);
  ASSERT_EQ(report.issues.size(), 1u);
  EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kContradicted);
  EXPECT_EQ(report.objects_bridged, 1u);
  Frame next = Showing(0.7, 5.7);
  next.poses.push_back({5, Pose::Translation(5.7, 0, 1)});
  EXPECT_TRUE(Applied(next).issues.empty());
  EXPECT_LT(Length(), 4.5);
  EXPECT_NEAR(CenterX(), 5.7, 0.1);
  EXPECT_FALSE(Object().bridged);
}

// As where an id is used again for something else.
TEST_F(ContradictedPlacement, PointsFarFromMotionAndPredictionBeginANewModel) {
  ShowMoving(false);
  Frame frame = Showing(0.6, 60);
  frame.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0.5)});
  const FrameReport report = Applied(frame);
  EXPECT_EQ(report.objects_restarted, 1u);
  ASSERT_EQ(report.issues.size(), 2u);
  EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kContradicted);
  EXPECT_EQ(report.issues[1].kind, ObjectIssueKind::kRestarted);
  EXPECT_LT(Length(), 4.5);
  EXPECT_NEAR(CenterX(), 60, 0.2);
}

// The rear end of a lorry, after its front end.
TEST_F(ContradictedPlacement, TheOtherEndOfAnObjectIsItsOwn) {
  Frame front = FrameAt(0);
  AddObject(front, 5, Pose::Translation(20, 0, 1), BoxSurface({0.5, 2, 2}, 0.2));
  front.poses.push_back({5, Pose::Translation(12, 0, 1)});
  Applied(front);
  Frame rear = FrameAt(1);
  AddObject(rear, 5, Pose::Translation(6, 0, 1), BoxSurface({0.5, 2, 2}, 0.2));
  rear.poses.push_back({5, Pose::Translation(14, 0, 1)});
  EXPECT_TRUE(Applied(rear).issues.empty());
  EXPECT_GT(Length(), 15);
}

// Motions the other way: inverted, or of another frame. Each is off by less than the van's size.
class WrongWay : public ContradictedPlacement, public testing::WithParamInterface<double> {};

TEST_P(WrongWay, IsLeftOutOnceRaysTell) {
  const double step_m = GetParam();  // along the way, across what the sensor sees
  std::size_t left_out = 0;
  for (int k = 0; k < 30; ++k) {
    Frame frame = FrameAt(0.1 * k);
    const Pose T_W_B = Pose::Translation(15, -8 + step_m * k, 1);
    AddObject(frame, 5, T_W_B, Facing({4, 2, 2}, T_W_B.translation));
    AddWall(25, 40, frame);
    if (k > 0) frame.motions.push_back({5, Pose::Translation(0, -step_m, 0), At(0.1 * (k - 1))});
    left_out += Applied(frame).motions_implausible;
  }
  EXPECT_GT(left_out, 10u);
  EXPECT_LT(Object().solid->box_O.Size().y(), 6.5);
}

TEST_P(WrongWay, SoIsWhatComesNearer) {
  const double step_m = GetParam();
  std::size_t left_out = 0;
  for (int k = 0; k < 25; ++k) {
    Frame frame = FrameAt(0.1 * k);
    const Pose T_W_B = Pose::Translation(30 - step_m * k, 0, 1);
    AddObject(frame, 5, T_W_B, Facing({4, 2, 2}, T_W_B.translation));
    if (k > 0) frame.motions.push_back({5, Pose::Translation(step_m, 0, 0), At(0.1 * (k - 1))});
    left_out += Applied(frame).motions_implausible;
  }
  EXPECT_GT(left_out, 3u);
  EXPECT_LT(Length(), 15);
}

INSTANTIATE_TEST_SUITE_P(SlowAndFast, WrongWay, testing::Values(0.4, 0.6, 0.9));

// A lorry of 16 m behind a wall with a gap of 4 m: a part of it after the other, both ends cut off.
TEST_F(ContradictedPlacement, WhatPassesAGapIsAsLongAsItIs) {
  for (int k = 0; k < 60; ++k) {
    Frame frame = FrameAt(0.1 * k);
    const Pose T_W_B = Pose::Translation(15, -12 + 0.5 * k, 1);
    for (const Eigen::Vector3d& p_B : Facing({2, 16, 2}, T_W_B.translation)) {
      const Eigen::Vector3d p_W = T_W_B * p_B;
      const Eigen::Vector3d in_wall_W = 7 / p_W.x() * p_W;
      const bool is_hidden = std::abs(in_wall_W.y()) > 1;
      AddPoint(frame, is_hidden ? kStaticLabel : 5, is_hidden ? in_wall_W : p_W);
    }
    if (k > 0) frame.motions.push_back({5, Pose::Translation(0, 0.5, 0), At(0.1 * (k - 1))});
    EXPECT_TRUE(Applied(frame).issues.empty()) << k;
  }
  EXPECT_GT(Object().solid->box_O.Size().y(), 15);
}

// The same at 8 m/s, with a pause or a start without motions and poses. Its side fills the gap: its
// points alone say that it stands.
TEST_F(ContradictedPlacement, WhatFillsAGapGoesAsItIsSaidTo) {
  for (const bool with_poses : {false, true}) {
    for (const int silent_until : {4, 14}) {
      dut_.Reset();
      std::size_t left_out = 0;
      for (int k = 0; k < 24; ++k) {
        Frame frame = FrameAt(0.1 * k);
        const Pose T_W_B = Pose::Translation(15, -9 + 0.8 * k, 1);
        for (const Eigen::Vector3d& p_B : Facing({2, 22, 2}, T_W_B.translation)) {
          const Eigen::Vector3d p_W = T_W_B * p_B;
          const Eigen::Vector3d in_wall_W = 7 / p_W.x() * p_W;
          const bool is_hidden = std::abs(in_wall_W.y()) > 0.5;
          AddPoint(frame, is_hidden ? kStaticLabel : 5, is_hidden ? in_wall_W : p_W);
        }
        const bool is_silent = k < silent_until && k >= silent_until - 4;
        if (!is_silent && with_poses) frame.poses.push_back({5, T_W_B});
        if (!is_silent && !with_poses && k > 0) {
          frame.motions.push_back({5, Pose::Translation(0, 0.8, 0), At(0.1 * (k - 1))});
        }
        left_out += Applied(frame).motions_implausible;
      }
      EXPECT_LE(left_out, 4u);
      EXPECT_NEAR(Object().SpeedMps(), 8, 0.5) << with_poses << silent_until;
    }
  }
}

// Its poses are turned by a right angle from one frame on.
TEST_F(ContradictedPlacement, ABoxThatIsTurnedIntoItsWidthIsLeftOut) {
  ShowMoving(true);
  const Eigen::Vector3d size_m = Object().solid->box_O.Size();
  for (int k = 6; k < 12; ++k) {
    Frame frame = Showing(0.1 * k, 5 + 0.1 * k);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.57, Eigen::Vector3d::UnitZ()));
    frame.poses.push_back({5, {turn, {5 + 0.1 * k, 0, 1}}});
    EXPECT_EQ(Applied(frame).motions_implausible, 1u) << k;
  }
  EXPECT_LT((Object().solid->box_O.Size() - size_m).norm(), 0.3);
}

// The id goes on to another van, with the motion of that one. Rays go on through where it was.
TEST_F(ContradictedPlacement, WhatIsSeenThroughBeginsAnew) {
  ShowMoving(false);
  Frame frame = Showing(0.6, 17.6);
  for (double y = -3; y <= 3; y += 0.2) {
    for (double z = 0; z <= 6; z += 0.2) AddPoint(frame, kStaticLabel, {30, y, z});
  }
  frame.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0.5)});
  const FrameReport report = Applied(frame);
  ASSERT_EQ(report.issues.size(), 2u);
  EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kContradicted);
  EXPECT_NEAR(report.issues[0].value, 12, 0.3);
  EXPECT_EQ(report.issues[1].kind, ObjectIssueKind::kRestarted);
  EXPECT_LT(Length(), 4.5);
  EXPECT_NEAR(CenterX(), 17.6, 0.2);
}

// Two tracks swap their ids; each goes on with the motion of what it now is.
TEST_F(ContradictedPlacement, WhereAnotherObjectStandsItIsNot) {
  const auto showing = [](double seconds, ObjectId near, ObjectId far) {
    Frame frame = FrameAt(seconds);
    AddObject(frame, near, Pose::Translation(5 + seconds, 0, 1), BoxSurface({4, 2, 2}, 0.2));
    AddObject(frame, far, Pose::Translation(17 + seconds, 0, 1), BoxSurface({4, 2, 2}, 0.2));
    for (const ObjectId id : {near, far}) {
      if (seconds == 0) continue;
      frame.motions.push_back({id, Pose::Translation(0.1, 0, 0), At(seconds - 0.1)});
    }
    return frame;
  };
  for (int k = 0; k < 6; ++k) EXPECT_TRUE(Applied(showing(0.1 * k, 5, 6)).issues.empty());
  const FrameReport report = Applied(showing(0.6, 6, 5));
  EXPECT_EQ(report.objects_restarted, 2u);
  EXPECT_LT(Length(), 4.5);
  EXPECT_NEAR(CenterX(), 17.6, 0.2);
  EXPECT_TRUE(Applied(showing(0.7, 6, 5)).issues.empty());
}

TEST_F(ContradictedPlacement, AMotionThatThePointsConfirmCounts) {
  ShowMoving(false);
  Frame frame = Showing(0.6, 6.7);
  frame.motions.push_back({5, Pose::Translation(1.2, 0, 0), At(0.5)});
  EXPECT_TRUE(Applied(frame).issues.empty());
  EXPECT_LT(Length(), 4.5);
  EXPECT_NEAR(CenterX(), 6.7, 0.1);
}

TEST_F(ContradictedPlacement, TwoStrayPointsSayNothing) {
  ShowMoving(false);
  Frame frame = FrameAt(0.6);
  AddPoint(frame, 5, {5.6, 0, 1});
  AddPoint(frame, 5, {5.7, 0, 1});
  frame.motions.push_back({5, Pose::Translation(8, 0, 0), At(0.5)});
  EXPECT_TRUE(Applied(frame).issues.empty());
}

TEST_F(ContradictedPlacement, AnObjectThatIsNotSeenGoesWhereItIsSaidToBe) {
  ShowMoving(false);
  Frame frame = FrameAt(0.6);
  frame.motions.push_back({5, Pose::Translation(40, 0, 0), At(0.5)});
  EXPECT_TRUE(Applied(frame).issues.empty());
  EXPECT_NEAR(CenterX(), 45.5, 0.1);
}

}  // namespace
}  // namespace clearway
