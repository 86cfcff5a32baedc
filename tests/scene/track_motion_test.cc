#include "scene/track_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

Time At(double seconds) { return Time() + FromSeconds(seconds); }

// At `per_s` poses a second for `lasts_s`, the last one at At(lasts_s).
std::vector<StampedPose> Track(double lasts_s, double per_s,
                               const std::function<Pose(double)>& T_W_O_at) {
  std::vector<StampedPose> track;
  for (int i = static_cast<int>(lasts_s * per_s); i >= 0; --i) {
    const double t_s = lasts_s - i / per_s;
    track.push_back({At(t_s), T_W_O_at(t_s)});
  }
  return track;
}

// Where the pose is after so long.
Pose Later(const StampedPose& pose, const Twist& velocity_O, double ahead_s) {
  return pose.T_W_O * Exp(ahead_s * velocity_O);
}

double Apart_m(const Pose& a, const Pose& b) { return (a.translation - b.translation).norm(); }

TEST(TrackMotion, AConstantScrewGoesOn) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose start = random.AnyPose(50);
    const Twist velocity_O{random.Vector(2), random.Vector(20)};
    const auto track = Track(random.Uniform(0.2, 4), random.Uniform(8, 30),
                             [&](double t_s) { return start * Exp(t_s * velocity_O); });
    const Twist dut = VelocityOfTrack(track, random.Vector(2));
    EXPECT_LT((dut.angular - velocity_O.angular).norm(), 1e-6) << i;
    EXPECT_LT((dut.linear - velocity_O.linear).norm(), 1e-5) << i;
  }
}

TEST(TrackMotion, OfTwoPosesIsTheLastMotion) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    // However far it turns, however long ago.
    const std::vector<StampedPose> track{
        {At(0), random.AnyPose(5)}, {At(std::pow(10, random.Uniform(-2, 4))), random.AnyPose(5)}};
    const Twist dut = VelocityOfTrack(track, random.Vector(1));
    const Pose again = Later(track[0], dut, ToSeconds(track[1].stamp - track[0].stamp));
    EXPECT_NEAR(Apart_m(again, track[1].T_W_O), 0, 1e-6) << i;
  }
}

// Frames of sensors that are triggered together are microseconds apart, and their poses have noise.
TEST(TrackMotion, PosesAtOnceTellNoVelocity) {
  const auto noisy = [](double t_s, double off) {
    return StampedPose{At(t_s),
                       {Eigen::Quaterniond(Eigen::AngleAxisd(off, Eigen::Vector3d::UnitZ())),
                        {2 * t_s + off, 0, 0}}};
  };
  std::vector<StampedPose> track{noisy(5, 0), noisy(5.00001, 0.01)};
  EXPECT_EQ(VelocityOfTrack(track, {1, 0, 0}), Twist{});
  track.push_back(noisy(5.00002, -0.01));
  EXPECT_EQ(VelocityOfTrack(track, {1, 0, 0}), Twist{});
  // With earlier poses, of long ago and of just now.
  for (const double before_s : {30.0, 1.0, 0.1}) {
    std::vector<StampedPose> longer = track;
    longer.insert(longer.begin(), noisy(5 - before_s, 0));
    const Twist dut = VelocityOfTrack(longer, {1, 0, 0});
    EXPECT_LT((dut.linear - Eigen::Vector3d(2, 0, 0)).norm(), 0.5) << before_s;
    EXPECT_LT(dut.angular.norm(), 0.5) << before_s;
  }
}

TEST(TrackMotion, OfTwoPosesTooCloseInTimeIsNone) {
  const std::vector<StampedPose> track{{At(1), Pose{}}, {At(1.004), Pose{{1, 0, 0, 0}, {1, 0, 0}}}};
  EXPECT_EQ(VelocityOfTrack(track, {0, 0, 0}), Twist{});
}

// However irregular it is, a scene must never hold what is no number.
TEST(TrackMotion, OfAnyTrackIsANumber) {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    std::vector<StampedPose> track;
    Time stamp = At(1);
    for (int k = random.Integer(2, 20); k > 0; --k) {
      stamp += Duration(1) + FromSeconds(std::pow(10, random.Uniform(-9, 2)));
      track.push_back({stamp, random.AnyPose(std::pow(10, random.Uniform(-6, 5)))});
      if (i % 2 == 0) track.back().T_W_O.rotation.setIdentity();
    }
    const Twist dut = VelocityOfTrack(track, random.Vector(5));
    EXPECT_TRUE(dut.angular.allFinite() && dut.linear.allFinite()) << i;
  }
}

TEST(TrackMotion, WhatTurnsFasterThanItIsSeenGoesOnAsBetweenTheLastTwo) {
  const auto track = Track(1, 10, [](double t_s) {
    return Pose{Eigen::Quaterniond(Eigen::AngleAxisd(20 * t_s, Eigen::Vector3d::UnitZ())),
                {t_s, 0, 0}};
  });
  EXPECT_EQ(VelocityOfTrack(track, {0, 0, 0}), VelocityBetween(track[9], track[10]));
}

TEST(TrackMotion, StandingStillIsNoMotion) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Pose T_W_O = random.AnyPose(1e4);
    const auto track = Track(2, 10, [&](double t_s) {
      return T_W_O * Pose::Translation(1e-11 * std::sin(1e3 * t_s), 0, 0);
    });
    EXPECT_EQ(VelocityOfTrack(track, {1, 2, 3}), Twist{});
  }
}

// Long ago it went another way.
TEST(TrackMotion, OldPosesAreForgotten) {
  const auto track = Track(4, 10, [](double t_s) {
    return Pose::Translation(std::max(0.0, t_s - 2), std::max(0.0, 2 - t_s), 0);
  });
  EXPECT_LT((VelocityOfTrack(track, {0, 0, 0}).linear - Eigen::Vector3d(1, 0, 0)).norm(), 1e-6);
}

// Errors a second ahead, of a car in a bend whose poses are noisy, by both models.
TEST(TrackMotion, NoiseEvensOut) {
  Random random(4);
  double by_track_m = 0, by_last_motion_m = 0;
  for (int i = 0; i < 200; ++i) {
    const Twist velocity_O{{0, 0, random.Uniform(-0.5, 0.5)}, {random.Uniform(1, 10), 0, 0}};
    auto track = Track(2, 10, [&](double t_s) {
      const Pose noise = Exp({0.01 * random.Vector(1), 0.05 * random.Vector(1)});
      return Exp(t_s * velocity_O) * noise;
    });
    const Pose truth = Exp(3 * velocity_O);
    const Twist last_motion = VelocityBetween(track.end()[-2], track.back());
    by_track_m += Apart_m(Later(track.back(), VelocityOfTrack(track, {0, 0, 0}), 1), truth);
    by_last_motion_m += Apart_m(Later(track.back(), last_motion, 1), truth);
  }
  EXPECT_LT(3 * by_track_m, by_last_motion_m);
}

// Strong accelerations are believed in part: they may be noise, and do not last.
TEST(TrackMotion, WhatGainsSpeedIsMetCloserASecondAhead) {
  const auto pose_at = [](double t_s) {
    return Pose::Translation(5 * t_s + 0.5 * t_s * t_s, 0, 0);
  };
  const auto track = Track(2, 10, pose_at);
  const auto error_m = [&](const Twist& velocity_O) {
    return Apart_m(Later(track.back(), velocity_O, 1), pose_at(3));
  };
  const double by_last_motion_m = error_m(VelocityBetween(track.end()[-2], track.back()));
  EXPECT_NEAR(by_last_motion_m, 0.55, 0.01);
  EXPECT_LT(error_m(VelocityOfTrack(track, {0, 0, 0})), 0.6 * by_last_motion_m);
}

TEST(TrackMotion, WhatBrakesStopsAndDoesNotComeBack) {
  const auto track = Track(
      2, 10, [](double t_s) { return Pose::Translation(-2 * (2.05 - t_s) * (2.05 - t_s), 0, 0); });
  EXPECT_EQ(VelocityOfTrack(track, {0, 0, 0}).linear, Eigen::Vector3d::Zero());
}

// It climbs a ramp at a steady rate, and nothing that noise says of its weight is believed.
TEST(TrackMotion, AlongTheVerticalSpeedsAreSteady) {
  const auto track =
      Track(2, 10, [](double t_s) { return Pose::Translation(0, 0, 0.5 * t_s * t_s); });
  const double up_mps = VelocityOfTrack(track, {0, 0, 0}).linear.z();
  EXPECT_GT(up_mps, 1.2);
  EXPECT_LT(up_mps, 2);
}

}  // namespace
}  // namespace clearway
