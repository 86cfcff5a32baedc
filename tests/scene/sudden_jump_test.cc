#include "scene/sudden_jump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "clearway/scene/timed_scene.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// Two cars of 4 x 2 x 2 m, 4 m beside each other, that go along x at 5 m/s, ten frames a second.
class SuddenJump : public testing::Test {
 protected:
  static Pose CarAt(int k, double y_m) { return Pose::Translation(5 + 0.5 * k, y_m, 1); }

  // Where each id is. With motions from the frame before, or with poses.
  struct Lanes {
    double y1_m = 0, y2_m = 4;
  };
  static Frame Showing(int k, const Lanes& before, const Lanes& now, bool with_poses) {
    Frame frame = FrameAt(0.1 * k);
    for (const auto& [id, from_m, to_m] :
         {std::tuple{1, before.y1_m, now.y1_m}, std::tuple{2, before.y2_m, now.y2_m}}) {
      AddObject(frame, id, CarAt(k, to_m), BoxSurface({4, 2, 2}, 0.2));
      if (with_poses) {
        frame.poses.push_back({id, CarAt(k, to_m)});
      } else if (k > 0) {
        const Pose H_W = CarAt(k, to_m) * Inverse(CarAt(k - 1, from_m));
        frame.motions.push_back({id, H_W, At(0.1 * (k - 1))});
      }
    }
    return frame;
  }
  FrameReport Applied(const Frame& frame) {
    const auto report = dut_.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    return report.ok() ? *report : FrameReport();
  }
  void Drive(int frames, bool with_poses) {
    for (int k = 0; k < frames; ++k) {
      EXPECT_TRUE(Applied(Showing(k, {}, {}, with_poses)).issues.empty()) << k;
    }
  }
  // In the middle of a car, so many frames after frame k.
  SpaceStatus StatusAhead(int k, int ahead, double y_m) {
    const ScenePtr scene = dut_.Publish();
    const Time t = At(0.1 * (k + ahead));
    return TimedScene(*scene, scene->stamp, t).At(CarAt(k + ahead, y_m).translation, t).status;
  }

  ThreadPool pool_{1};
  SceneBuilder dut_{SceneParams{}, FrameLimits{}, pool_};
};

// The cars are where they were, but each is called as the other one.
TEST_F(SuddenJump, SwappedIdsBeginNewModelsAndNothingIsFreeAhead) {
  for (const bool with_poses : {false, true}) {
    dut_.Reset();
    Drive(10, with_poses);
    const FrameReport report = Applied(Showing(10, {0, 4}, {4, 0}, with_poses));
    EXPECT_EQ(report.motions_implausible, 2u) << with_poses;
    EXPECT_EQ(report.objects_restarted, 2u);
    ASSERT_EQ(report.issues.size(), 4u);
    EXPECT_EQ(report.issues[0].kind, ObjectIssueKind::kJumped);
    EXPECT_NEAR(report.issues[0].value, 4, 0.1);
    EXPECT_LT(report.issues[0].limit, 3);
    for (const double y_m : {0.0, 4.0}) {
      EXPECT_EQ(StatusAhead(10, 0, y_m), SpaceStatus::kOccupied) << y_m;
      EXPECT_EQ(StatusAhead(10, 1, y_m), SpaceStatus::kOccupied) << y_m;
      EXPECT_EQ(StatusAhead(10, 2, y_m), SpaceStatus::kOccupied) << y_m;
    }
    for (int k = 11; k < 14; ++k) {
      EXPECT_TRUE(Applied(Showing(k, {4, 0}, {4, 0}, with_poses)).issues.empty()) << k;
    }
    EXPECT_NEAR(dut_.Publish()->FindObject(1)->SpeedMps(), 5, 0.1);
    EXPECT_LT(dut_.Publish()->FindObject(1)->solid->box_O.Size().y(), 2.5);
  }
}

// Boxes whose heading is off by less than half a turn: the points are where they were predicted.
TEST_F(SuddenJump, ABoxThatIsTurnedRoundIsLeftOut) {
  Drive(10, false);
  Frame frame = Showing(10, {}, {}, false);
  const Pose turn{Eigen::Quaterniond(Eigen::AngleAxisd(2.75, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d::Zero()};
  frame.motions[0].H_W = CarAt(10, 0) * turn * Inverse(CarAt(9, 0));
  const FrameReport report = Applied(frame);
  ASSERT_EQ(report.issues.size(), 1u);
  EXPECT_EQ(report.motions_implausible, 1u);
  EXPECT_EQ(report.objects_bridged, 1u);
  EXPECT_EQ(StatusAhead(10, 2, 0), SpaceStatus::kOccupied);
  EXPECT_LT(dut_.Publish()->FindObject(1)->solid->box_O.Size().x(), 4.5);
}

// Nobody knows yet which way it goes, but nothing turns like that.
TEST_F(SuddenJump, SoIsOneOfTheFirstMotion) {
  Applied(Showing(0, {}, {}, false));
  Frame frame = Showing(1, {}, {}, false);
  const Pose turn{Eigen::Quaterniond(Eigen::AngleAxisd(2.75, Eigen::Vector3d::UnitZ())),
                  Eigen::Vector3d::Zero()};
  frame.motions[0].H_W = CarAt(1, 0) * turn * Inverse(CarAt(0, 0));
  const FrameReport report = Applied(frame);
  ASSERT_EQ(report.issues.size(), 1u);
  EXPECT_EQ(report.motions_implausible, 1u);
  EXPECT_LT(dut_.Publish()->FindObject(1)->solid->box_O.Size().x(), 4.5);
}

// Poses whose heading is off by so much in frame k, of a car whose first view is of its side alone:
// then O is not where the box is.
class TurnedHeadings : public SuddenJump {
 protected:
  FrameReport Drive(int frames, const std::function<double(int)>& x_m,
                    const std::function<double(int)>& turn_rad) {
    dut_.Reset();
    FrameReport sum;
    for (int k = 0; k < frames; ++k) {
      Frame frame = FrameAt(0.1 * k);
      std::vector<Eigen::Vector3d> seen = BoxSurface(box_m_, 0.2);
      if (k == 0)
        std::erase_if(seen,
                      [&](const Eigen::Vector3d& p_B) { return p_B.y() > 0.1 - box_m_.y() / 2; });
      const Pose T_W_B = Pose::Translation(x_m(k), 4, 1);
      AddObject(frame, 1, T_W_B, seen);
      const Eigen::AngleAxisd turn(turn_rad(k), Eigen::Vector3d::UnitZ());
      const Pose T_W_turned = T_W_B * Pose{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()};
      frame.poses = {{1, T_W_turned * Pose::Translation(origin_x_m_, 0, 0)}};
      sum.motions_implausible += Applied(frame).motions_implausible;
    }
    scene_ = dut_.Publish();
    return sum;
  }
  Eigen::Vector3d Velocity_W() const {
    const MovingObject& car = *scene_->FindObject(1);
    return car.LastPose().T_W_O.rotation * car.velocity_O->linear;
  }
  SpaceStatus StatusAt(double x_m, double seconds) const {
    const Time t = At(seconds);
    return TimedScene(*scene_, scene_->stamp, t).At({x_m, 4, 1}, t).status;
  }
  Eigen::Vector3d Size_m() const { return scene_->FindObject(1)->solid->box_O.Size(); }

  Eigen::Vector3d box_m_{4, 2, 2};
  double origin_x_m_ = 0;  // of the source's frame, in the box
  ScenePtr scene_;
};

TEST_F(TurnedHeadings, AreNamedAndChangeNeitherVelocityNorSize) {
  const std::function<bool(int)> kTurned[] = {
      [](int k) { return k >= 19; }, [](int k) { return k >= 18; }, [](int k) { return k >= 12; },
      [](int k) { return k % 2 == 1; }, [](int k) { return k / 2 % 2 == 1; }};
  for (const double turn_rad : {1.1, 1.57, 2.4, 3.14}) {
    for (const auto& turned : kTurned) {
      const FrameReport report = Drive(
          20, [](int k) { return 5 + 0.5 * k; }, [&](int k) { return turned(k) * turn_rad; });
      const testing::ScopedTrace trace(__FILE__, __LINE__, std::to_string(turn_rad));
      EXPECT_GT(report.motions_implausible, 0u);
      EXPECT_LT((Velocity_W() - Eigen::Vector3d(5, 0, 0)).norm(), 0.3);
      EXPECT_LT(Size_m().x(), 4.6);
      EXPECT_LT(Size_m().y(), 2.6);
      EXPECT_EQ(StatusAt(5 + 0.5 * 29, 2.9), SpaceStatus::kOccupied);
    }
  }
}

// The pose is used, since it may be right, but the velocity ignores its turn.
TEST_F(TurnedHeadings, OfAWalkerByFortyFiveDegreesDoNotChangeTheVelocity) {
  box_m_ = {0.6, 0.6, 1.8};
  const auto x_m = [](int k) { return 5 + 0.14 * k; };
  Drive(20, x_m, [](int k) { return k == 19 ? 0.785 : 0; });
  EXPECT_LT((Velocity_W() - Eigen::Vector3d(1.4, 0, 0)).norm(), 0.2);
  EXPECT_EQ(StatusAt(x_m(29), 2.9), SpaceStatus::kOccupied);
}

// A source whose frames are at the rear axle.
TEST_F(TurnedHeadings, AboutAnotherPointThanTheFramesOriginChangeNothingEither) {
  origin_x_m_ = -1.4;
  Drive(
      20, [](int k) { return 5 + 0.5 * k; }, [](int k) { return k / 2 % 2 == 1 ? 3.14 : 0; });
  EXPECT_LT((Velocity_W() - Eigen::Vector3d(5, 0, 0)).norm(), 0.5);
  EXPECT_LT(Size_m().x(), 4.6);
  EXPECT_EQ(StatusAt(5 + 0.5 * 24, 2.4), SpaceStatus::kOccupied);
}

TEST_F(TurnedHeadings, OfABrakingCarDoNotKeepItGoing) {
  double x_m = 5;
  Drive(
      24, [&](int k) { return x_m += 0.1 * std::max(0.0, 10 - 0.5 * k); },
      [](int k) { return k / 2 % 2 == 1 ? 3.14 : 0; });
  EXPECT_LT(Velocity_W().norm(), 0.6);
  EXPECT_EQ(StatusAt(x_m, 3.3), SpaceStatus::kOccupied);
}

TEST_F(SuddenJump, MotionsThatTurnByARightAngleAreLeftOutWithHoweverFewPoints) {
  for (const bool few : {false, true}) {
    dut_.Reset();
    for (int k = 0; k < 11; ++k) {
      Frame frame = FrameAt(0.1 * k);
      AddObject(frame, 1, CarAt(k, 4),
                few ? std::vector<Eigen::Vector3d>{{-2, 0, 0}, {-2, 0.5, 0}}
                    : BoxSurface({4, 2, 2}, 0.2));
      const Eigen::AngleAxisd turn(k == 10 ? 1.57 : 0, Eigen::Vector3d::UnitZ());
      const Pose T_W_B = CarAt(k, 4) * Pose{Eigen::Quaterniond(turn), Eigen::Vector3d::Zero()};
      if (k > 0) frame.motions = {{1, T_W_B * Inverse(CarAt(k - 1, 4)), At(0.1 * (k - 1))}};
      EXPECT_EQ(Applied(frame).motions_implausible, k == 10 ? 1u : 0u) << few << " " << k;
    }
    EXPECT_NEAR(dut_.Publish()->FindObject(1)->SpeedMps(), 5, 0.3) << few;
  }
}

// Its own newest pose counts, not the last of its stated ones.
TEST_F(SuddenJump, WhatKeepsToItsStatedFutureIsNoJump) {
  Drive(10, false);
  Pose T_W_O = dut_.Publish()->FindObject(1)->LastPose().T_W_O;
  T_W_O.translation.x() += 10;
  ASSERT_TRUE(dut_.SetFuture(1, {{At(2.9), T_W_O}}).ok());
  for (int k = 10; k < 13; ++k) {
    EXPECT_TRUE(Applied(Showing(k, {}, {}, false)).issues.empty()) << k;
  }
}

// Somebody who walks, turns round within half a second, and walks back.
TEST_F(SuddenJump, WhoTurnsRoundIsNoJump) {
  Pose T_W_B = CarAt(0, 0);
  for (int k = 0; k < 30; ++k) {
    const bool turns = k >= 15 && k < 20;
    const Eigen::AngleAxisd turn(turns ? 0.628 : 0, Eigen::Vector3d::UnitZ());
    T_W_B = T_W_B * Pose{Eigen::Quaterniond(turn), Eigen::Vector3d(turns ? 0.02 : 0.14, 0, 0)};
    Frame frame = FrameAt(0.1 * k);
    AddObject(frame, 1, T_W_B, BoxSurface({0.5, 0.6, 1.8}, 0.1));
    frame.poses = {{1, T_W_B}};
    EXPECT_TRUE(Applied(frame).issues.empty()) << k;
  }
  EXPECT_NEAR(dut_.Publish()->FindObject(1)->SpeedMps(), 1.4, 0.1);
}

// It goes out of sight, turns, and comes back: its poses count from the first on.
TEST_F(SuddenJump, WhatTurnsUnseenForASecondIsNoJump) {
  for (const double turn_rad : {2.9, 3.14}) {
    dut_.Reset();
    const Eigen::AngleAxisd turn(turn_rad, Eigen::Vector3d::UnitZ());
    for (int k = 0; k < 30; ++k) {
      if (k >= 10 && k < 19) continue;
      const double x_m = k < 10 ? 5 + 0.2 * k : 7 - 0.2 * (k - 10);
      Pose T_W_B = Pose::Translation(x_m, 4, 1);
      if (k >= 10) T_W_B.rotation = Eigen::Quaterniond(turn);
      Frame frame = FrameAt(0.1 * k);
      AddObject(frame, 1, T_W_B, BoxSurface({4, 2, 2}, 0.2));
      frame.poses = {{1, T_W_B}};
      EXPECT_TRUE(Applied(frame).issues.empty()) << turn_rad << " " << k;
    }
    EXPECT_NEAR(dut_.Publish()->FindObject(1)->SpeedMps(), 2, 0.2) << turn_rad;
    EXPECT_LT(dut_.Publish()->FindObject(1)->solid->box_O.Size().x(), 4.6) << turn_rad;
  }
}

// As hard as anything on wheels can: 10 m/s^2, and a quarter turn within half a second.
TEST_F(SuddenJump, WhatBrakesAndTurnsIsNoJump) {
  Pose T_W_B = CarAt(0, 0);
  double speed_mps = 15;
  for (int k = 0; k < 40; ++k) {
    Frame frame = FrameAt(0.1 * k);
    const bool brakes = k >= 10 && k < 20, turns = k >= 25 && k < 30;
    if (brakes) speed_mps = std::max(2.0, speed_mps - 1);
    const Pose step{
        Eigen::Quaterniond(Eigen::AngleAxisd(turns ? 0.314 : 0, Eigen::Vector3d::UnitZ())),
        Eigen::Vector3d(0.1 * speed_mps, 0, 0)};
    const Pose from = T_W_B;
    T_W_B = T_W_B * step;
    AddObject(frame, 1, T_W_B, BoxSurface({4, 2, 2}, 0.2));
    if (k > 0) frame.motions.push_back({1, T_W_B * Inverse(from), At(0.1 * (k - 1))});
    EXPECT_TRUE(Applied(frame).issues.empty()) << k;
  }
}

}  // namespace
}  // namespace clearway
