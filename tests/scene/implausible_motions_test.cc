#include "scene/implausible_motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

class ImplausibleMotions : public testing::Test {
 protected:
  // A van at (9, 3, 1), and static points.
  static Frame Showing(double seconds, double x_m) {
    Frame frame = FrameAt(seconds);
    AddPoint(frame, kStaticLabel, {-5, 0, 0});
    AddObject(frame, 2, Pose::Translation(x_m, 3, 1), BoxSurface({4, 2, 2}, 0.1));
    return frame;
  }
  static Pose Turn(double angle_rad) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ())),
            Eigen::Vector3d::Zero()};
  }
  FrameReport Applied(const Frame& frame) {
    const auto report = dut_.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    return report.ok() ? *report : FrameReport();
  }
  ThreadPool pool_{1};
  SceneBuilder dut_{SceneParams{}, {.max_coordinate_m = 100}, pool_};
};

TEST_F(ImplausibleMotions, ATurnOfNearlyHalfATurnIsLeftOutAndNamed) {
  Applied(Showing(0, 9));
  Frame frame = Showing(0.1, 10);
  frame.motions.push_back({2, Pose::Translation(19, 6, 0) * Turn(std::numbers::pi), At(0)});
  const FrameReport report = Applied(frame);
  EXPECT_EQ(report.motions_implausible, 1u);
  ASSERT_EQ(report.issues.size(), 1u);
  EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kTurnTooLarge);
  EXPECT_EQ(report.issues[0].id, 2);
  EXPECT_NEAR(report.issues[0].value, std::numbers::pi, 1e-9);
  EXPECT_EQ(report.issues[0].limit, kMaxTurn_rad);
  const ScenePtr scene = dut_.Publish();
  EXPECT_EQ(scene->static_map_W.State(scene->static_map_W.grid().KeyOf({-5, 0, 0})),
            VoxelState::kOccupied);
  EXPECT_EQ(scene->FindObject(2)->last_seen, At(0.1));
  EXPECT_LT(scene->FindObject(2)->solid->box_O.Size().x(), 4.5);
}

TEST_F(ImplausibleMotions, ATurnJustBelowTheLimitCounts) {
  Applied(Showing(0, 9));
  Frame frame = FrameAt(0.1);
  frame.motions.push_back({2, Turn(0.89 * std::numbers::pi), At(0)});
  EXPECT_EQ(Applied(frame).motions_implausible, 0u);
  EXPECT_EQ(dut_.Publish()->FindObject(2)->t_k(), At(0.1));
}

TEST_F(ImplausibleMotions, AMotionThatLeadsTooFarIsLeftOutAndNamed) {
  Applied(Showing(0, 9));
  for (const double far_m : {98.0, 250.0, 1e9, 1e300}) {
    Frame frame = FrameAt(0.1);
    frame.motions.push_back({2, Pose::Translation(0, far_m, 0), At(0)});
    frame.motions.push_back({7, Pose::Translation(0, 0.1, 0), At(0)});  // of no known object
    frame.sensor_id = std::to_string(far_m);
    const FrameReport report = Applied(frame);
    EXPECT_EQ(report.motions_implausible, 1u) << far_m;
    EXPECT_EQ(report.motions_ignored, 1u) << far_m;
    ASSERT_EQ(report.issues.size(), 1u) << far_m;
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kMotionTooFar);
    EXPECT_EQ(report.issues[0].limit, 100);
    EXPECT_GT(report.issues[0].value, 97);
  }
  EXPECT_EQ(dut_.Publish()->FindObject(2)->t_k(), At(0));
}

// Whether the scene knows the object or not. The rest of the frame counts.
TEST_F(ImplausibleMotions, APoseThatIsTooFarIsLeftOutAndNamed) {
  for (const double far_m : {101.0, 1e9, 1e300}) {
    dut_.Reset();
    for (int k = 0; k < 3; ++k) {
      Frame frame = Showing(0.1 * k, 9);
      frame.poses.push_back({2, Pose::Translation(0, k == 1 ? 3 : -far_m, 0)});
      const FrameReport report = Applied(frame);
      ASSERT_EQ(report.issues.size(), k == 1 ? 0u : 1u) << far_m << " " << k;
      if (k == 1) continue;
      EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kMotionTooFar);
      EXPECT_EQ(report.issues[0].value, far_m);
      EXPECT_EQ(report.issues[0].limit, 100);
    }
    EXPECT_EQ(dut_.Publish()->FindObject(2)->last_seen, At(0.2));
  }
}

// The van drives out of the space that there is; the static points of its frames still count.
TEST_F(ImplausibleMotions, WhatIsBeyondTheLimitIsLeftOutAlone) {
  for (const bool posed : {false, true}) {
    dut_.Reset();
    for (int k = 0; k < 12; ++k) {
      const double x_m = 90 + 1.5 * k;
      Frame frame = Showing(0.1 * k, x_m);
      if (posed && x_m <= 100) frame.poses.push_back({2, Pose::Translation(x_m, 3, 1)});
      const FrameReport report = Applied(frame);
      if (k == 11) {
        EXPECT_EQ(report.points_out_of_bounds, frame.points_S.size() - 1);
      }
    }
    const ScenePtr scene = dut_.Publish();
    EXPECT_EQ(scene->stamp, At(1.1));
    EXPECT_LT(scene->FindObject(2)->last_seen, At(1.1));
  }
}

TEST_F(ImplausibleMotions, AMalformedOneRefusesTheFrame) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Frame frame = Showing(0.1, 10);
    frame.motions.push_back({2, Pose::Translation(bad, 0, 0), At(0)});
    EXPECT_EQ(dut_.Apply(frame).status().code(), absl::StatusCode::kInvalidArgument);
  }
}

TEST_F(ImplausibleMotions, OfANewObjectTheFirstVelocityIsNotKnown) {
  Frame frame = Showing(0.1, 10);
  frame.motions.push_back({2, Turn(3), At(0)});
  EXPECT_EQ(Applied(frame).motions_implausible, 1u);
  EXPECT_FALSE(dut_.Publish()->FindObject(2)->velocity_O.has_value());
}

// from_stamp_ns is zero, or of a clock that is an hour or two seconds behind: without a check the
// van would hardly move between two restarts, and its place a second ahead would be free.
TEST_F(ImplausibleMotions, WhatStartsLongBeforeTheObjectWasSeenIsLeftOutAndNamed) {
  constexpr double kNow_s = 1.7e9, kSpeed_mps = 5;
  for (const double from_s : {-kNow_s, -3600.0, -2.0}) {
    dut_.Reset();
    for (int k = 0; k < 8; ++k) {
      const double now_s = kNow_s + 0.1 * k, x_m = 9 + kSpeed_mps * 0.1 * k;
      Frame frame = Showing(now_s, x_m);
      const Time from = At(now_s - 0.1) + FromSeconds(from_s);
      frame.motions.push_back({2, Pose::Translation(0.1 * kSpeed_mps, 0, 0), from});
      const FrameReport report = Applied(frame);
      ASSERT_GE(report.issues.size(), 1u) << from_s << " " << k;
      EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kStartsTooEarly);
      EXPECT_NEAR(report.issues[0].value, 0.1 - from_s, 0.8);
      EXPECT_EQ(report.issues[0].limit, 1);
      EXPECT_EQ(report.motions_implausible, 1u);
    }
    // From its points: motions that are left out count as none.
    const ScenePtr scene = dut_.Publish();
    EXPECT_NEAR(scene->FindObject(2)->SpeedMps(), kSpeed_mps, 0.5) << from_s;
  }
}

TEST_F(ImplausibleMotions, AMotionMayStartASecondBeforeTheObjectWasSeen) {
  Frame frame = Showing(1, 10);
  frame.motions.push_back({2, Pose::Translation(1, 0, 0), At(0)});
  EXPECT_EQ(Applied(frame).motions_implausible, 0u);
  EXPECT_NEAR(dut_.Publish()->FindObject(2)->SpeedMps(), 1, 1e-9);
}

class TooFastMotions : public ImplausibleMotions {
 protected:
  void ExpectTooFast(const FrameReport& report, double speed_mps) {
    EXPECT_EQ(report.motions_implausible, 1u);
    ASSERT_EQ(report.issues.size(), 1u);
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kMotionTooFast);
    EXPECT_EQ(report.issues[0].id, 2);
    EXPECT_NEAR(report.issues[0].value, speed_mps, 0.02 * speed_mps);
    EXPECT_EQ(report.issues[0].limit, kMaxSpeed_mps);
  }
  SceneBuilder far_{SceneParams{}, FrameLimits{}, pool_};
};

TEST_F(TooFastMotions, AreLeftOutAndNamed) {
  ASSERT_TRUE(far_.Apply(Showing(0, 9)).ok());
  Frame frame = FrameAt(0.1);
  frame.motions.push_back({2, Pose::Translation(0, 10'000, 0), At(0)});
  ExpectTooFast(*far_.Apply(frame), 100'000);
  EXPECT_EQ(far_.Publish()->FindObject(2)->t_k(), At(0));
  frame = FrameAt(0.2);
  frame.motions.push_back({2, Pose::Translation(0, 190, 0), At(0)});
  EXPECT_TRUE(far_.Apply(frame)->issues.empty());
}

TEST_F(TooFastMotions, OfANewObject) {
  Frame frame = Showing(0.1, 10);
  frame.motions.push_back({2, Pose::Translation(0, 10'000, 0), At(0)});
  ExpectTooFast(*far_.Apply(frame), 100'000);
  EXPECT_FALSE(far_.Publish()->FindObject(2)->velocity_O.has_value());
}

// The next pose counts again, or the same one once there was time to get there.
TEST_F(TooFastMotions, OfPoses) {
  const auto at = [&](double seconds, double x_m) {
    Frame frame = FrameAt(seconds);
    frame.poses.push_back({2, Pose::Translation(x_m, 3, 1)});
    return *far_.Apply(frame);
  };
  Frame first = Showing(0, 9);
  first.poses.push_back({2, Pose::Translation(9, 3, 1)});
  ASSERT_TRUE(far_.Apply(first).ok());
  ExpectTooFast(at(0.1, 509), 5'000);
  EXPECT_EQ(far_.Publish()->FindObject(2)->t_k(), At(0));
  EXPECT_TRUE(at(0.2, 9).issues.empty());
  ExpectTooFast(at(0.3, 509), 5'000);
  EXPECT_TRUE(at(0.8, 509).issues.empty());
}

// Two sensors at once: their frames' stamps are 10 microseconds apart. The poses of an object that
// stands still are off by a centimetre.
TEST_F(TooFastMotions, NoiseBetweenTwoSensorsIsNoSpeed) {
  for (const bool by_motion : {false, true}) {
    for (const auto model : {MotionModel::kLastMotion, MotionModel::kTrack}) {
      SceneParams params;
      params.motion = model;
      SceneBuilder dut(params, FrameLimits{}, pool_);
      Time last = At(0);
      for (int k = 0; k < 20; ++k) {
        Frame frame = Showing(0.1 * (k / 2), 9);
        frame.stamp += std::chrono::microseconds(10 * (k % 2));
        frame.sensor_id = k % 2 == 0 ? "front" : "rear";
        const double off_m = k % 4 < 2 ? 0.01 : -0.01;
        if (!by_motion) frame.poses.push_back({2, Pose::Translation(9 + off_m * (k % 2), 3, 1)});
        if (by_motion && k > 0) frame.motions.push_back({2, Pose::Translation(off_m, 0, 0), last});
        last = frame.stamp;
        const auto report = dut.Apply(frame);
        ASSERT_TRUE(report.ok()) << report.status();
        EXPECT_EQ(report->motions_implausible, 0u);
      }
      EXPECT_LT(dut.Publish()->FindObject(2)->SpeedMps(), 0.5);
    }
  }
}

// A centimetre within a nanosecond.
TEST_F(TooFastMotions, ATinyStepTellsNoVelocity) {
  Frame first = Showing(0.1, 9);
  first.motions.push_back({2, Pose::Translation(0.01, 0, 0), At(0.1) - Duration(1)});
  ASSERT_TRUE(far_.Apply(first).ok());
  EXPECT_FALSE(far_.Publish()->FindObject(2)->velocity_O.has_value());
  Frame next = Showing(0.2, 9.1);
  next.motions.push_back({2, Pose::Translation(0.1, 0, 0), At(0.1)});
  ASSERT_TRUE(far_.Apply(next).ok());
  EXPECT_NEAR(far_.Publish()->FindObject(2)->SpeedMps(), 1, 1e-6);
  Frame soon = Showing(0.2, 9.11);
  soon.stamp += Duration(1);
  soon.motions.push_back({2, Pose::Translation(0.01, 0, 0), At(0.2)});
  ASSERT_TRUE(far_.Apply(soon).ok());
  EXPECT_NEAR(far_.Publish()->FindObject(2)->SpeedMps(), 1.1, 0.01);
}

TEST_F(ImplausibleMotions, TheListIsBounded) {
  Frame frame = FrameAt(0);
  for (ObjectId id = 1; id <= 100; ++id) frame.motions.push_back({id, Turn(3), At(-1)});
  const FrameReport report = Applied(frame);
  EXPECT_EQ(report.motions_implausible, 100u);
  EXPECT_EQ(report.issues.size(), kMaxObjectIssues);
}

}  // namespace
}  // namespace clearway
