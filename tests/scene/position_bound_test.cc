// How far from where it is predicted an object is said to be at most.
#include "scene/position_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "scene/object_motion.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;
using testing_support::Random;

SceneParams ByTrack(double rest_distance_m = 0) {
  SceneParams params;
  params.motion = MotionModel::kTrack;
  params.rest_distance_m = rest_distance_m;
  return params;
}

Solid CarBody() {
  Solid solid;
  solid.box_O = {{-2, -1, 0}, {2, 1, 1.5}};
  solid.radius_m = 2.7;
  return solid;
}

std::vector<StampedPose> Track(int poses, const std::function<Pose(double)>& T_W_O_at) {
  std::vector<StampedPose> track;
  for (int k = 0; k < poses; ++k) track.push_back({At(0.1 * k), T_W_O_at(0.1 * k)});
  return track;
}

// With the velocity that follows from the track.
PositionBound BoundWith(const std::vector<StampedPose>& track, const SceneParams& params) {
  const std::size_t size = track.size();
  const Twist last_O = VelocityBetween(track[size - 2], track[size - 1]);
  return BoundOf(track, Time::min(), GoesOn(track, last_O, CarBody(), params), CarBody(), params);
}

Pose Steady(double t) { return Pose::Translation(8 * t, 0, 0); }

TEST(PositionBound, GrowsWithTime) {
  const PositionBound dut{0.1, 0.2, 0.6};
  EXPECT_EQ(dut.At(-1), 0);
  EXPECT_EQ(dut.At(0), 0.1);
  EXPECT_DOUBLE_EQ(dut.At(2), 0.1 + 0.4 + 1.2);
  EXPECT_DOUBLE_EQ(dut.Rate(2), 1.4);
}

TEST(PositionBound, ShrinksForWhatKeepsItsMotion) {
  const SceneParams params = ByTrack();
  const double young_m = BoundWith(Track(3, Steady), params).At(2);
  const double known_m = BoundWith(Track(20, Steady), params).At(2);
  const double well_known_m = BoundWith(Track(60, Steady), params).At(2);
  EXPECT_GT(young_m, 2);
  EXPECT_LT(known_m, 0.9 * young_m);
  EXPECT_LT(well_known_m, 0.8 * known_m);
  EXPECT_GT(well_known_m, 0.5);  // it may still brake
}

TEST(PositionBound, IsWiderForWhatSwerves) {
  const auto swerves = [](double t) { return Pose::Translation(8 * t, std::sin(2 * t), 0); };
  const SceneParams params = ByTrack();
  EXPECT_GT(BoundWith(Track(60, swerves), params).At(1),
            1.5 * BoundWith(Track(60, Steady), params).At(1));
}

TEST(PositionBound, IsWiderForWhatIsFast) {
  const auto slow = [](double t) { return Pose::Translation(0.5 * t, 0, 0); };
  const SceneParams params = ByTrack();
  EXPECT_LT(BoundWith(Track(4, slow), params).At(2),
            0.5 * BoundWith(Track(4, Steady), params).At(2));
}

TEST(PositionBound, OfWhatRestsGrowsEvenly) {
  const auto rests = [](double t) { return Pose::Translation(0.02 * std::sin(40 * t), 0, 0); };
  const PositionBound dut = BoundWith(Track(60, rests), ByTrack(0.6));
  EXPECT_EQ(dut.accel_mps2, 0);
  EXPECT_LT(dut.At(3), 0.7);
  EXPECT_GT(dut.At(3), dut.At(1));
}

// Objects whose velocity wanders, seen with noise: they are within their bounds as often as stated,
// by either rule, and the bounds are not much wider than their errors need.
TEST(PositionBound, HoldsForNinetyFiveInAHundredAndIsNotMuchWider) {
  for (const MotionModel model : {MotionModel::kTrack, MotionModel::kLastMotion}) {
    SceneParams params = ByTrack();
    params.motion = model;
    Random random(3);
    std::vector<double> errors_m, bounds_m;
    double within = 0;
    for (int object = 0; object < 60; ++object) {
      const double wanders_mps = random.Uniform(0.05, 0.25);  // in a tenth of a second
      Eigen::Vector3d velocity_mps(random.Uniform(3, 9), 0, 0), p = Eigen::Vector3d::Zero();
      std::vector<Eigen::Vector3d> truth;
      std::vector<StampedPose> seen;
      for (int k = 0; k < 80; ++k) {
        velocity_mps += wanders_mps * Eigen::Vector3d(random.Normal(), random.Normal(), 0);
        p += 0.1 * velocity_mps;
        truth.push_back(p);
        const Eigen::Vector3d noise(0.02 * random.Normal(), 0.02 * random.Normal(), 0);
        seen.push_back({At(0.1 * k), {Eigen::Quaterniond::Identity(), p + noise}});
      }
      for (int k = 20; k + 10 < 80; k += 5) {
        const std::span<const StampedPose> track(seen.data(), k + 1);
        const Twist last_O = VelocityBetween(track[k - 1], track[k]);
        const Twist velocity_O = GoesOn(track, last_O, CarBody(), params);
        const Eigen::Vector3d moves = Exp(1.0 * velocity_O).translation;
        const double error_m = (truth[k] + moves - truth[k + 10]).norm();
        errors_m.push_back(error_m);
        bounds_m.push_back(BoundOf(track, Time::min(), velocity_O, CarBody(), params).At(1));
        within += error_m <= bounds_m.back();
      }
    }
    const std::size_t all = errors_m.size();
    EXPECT_GT(within, 0.93 * static_cast<double>(all));
    std::ranges::sort(errors_m);
    std::ranges::sort(bounds_m);
    EXPECT_LT(bounds_m[all / 2], 2 * errors_m[all * 95 / 100]);
  }
}

// A steady drive, each of whose poses is off.
std::vector<StampedPose> NoisyTrack(int poses, double noise_m, Random& random) {
  return Track(poses, [&](double t) {
    return Pose{Eigen::Quaterniond::Identity(),
                Steady(t).translation +
                    noise_m * Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal())};
  });
}

// However young the track is: of four poses, that of three is predicted and compared with the last.
TEST(PositionBound, HoldsForTracksOfNoisyPoses) {
  Random random(5);
  for (const int poses : {4, 7, 12, 60}) {
    int within = 0;
    constexpr int kAll = 300;
    for (int i = 0; i < kAll; ++i) {
      const auto track = NoisyTrack(poses, 0.3, random);
      const Twist last_O = VelocityBetween(track[poses - 2], track[poses - 1]);
      const SceneParams params = ByTrack();
      const Twist velocity_O = GoesOn(track, last_O, CarBody(), params);
      const Eigen::Vector3d moves = Exp(1.0 * velocity_O).translation;
      const double error_m = (moves - Steady(1).translation).norm();
      within += error_m <= BoundOf(track, Time::min(), velocity_O, CarBody(), params).At(1);
    }
    EXPECT_GT(within, (poses == 4 ? 0.85 : 0.93) * kAll) << poses;
  }
}

TEST(PositionBound, OfNoiseGrowsEvenly) {
  Random random(6);
  const PositionBound noisy = BoundWith(NoisyTrack(60, 0.5, random), ByTrack());
  const PositionBound calm = BoundWith(Track(60, Steady), ByTrack());
  EXPECT_GT(calm.At(3), 5 * calm.At(1));
  EXPECT_LT(noisy.At(3), 4 * noisy.At(1));
}

// Long before the poses of half a second are in.
TEST(PositionBound, WidensSoonWhenPosesBecomeNoisy) {
  Random random(7);
  std::vector<StampedPose> track = Track(60, Steady);
  const double calm_m = BoundWith(track, ByTrack()).At(1);
  const auto noisy = NoisyTrack(64, 0.5, random);
  track.insert(track.end(), noisy.begin() + 60, noisy.end());
  EXPECT_GT(BoundWith(track, ByTrack()).At(1), 2.5 * calm_m);
}

TEST(PositionBound, OfOnePoseIsThatOfWhatMayGoAnywhere) {
  const PositionBound dut = BoundOf(Track(1, Steady), Time::min(), {}, CarBody(), ByTrack());
  EXPECT_EQ(dut.At(0), 0);
  EXPECT_EQ(dut.At(2), 2 * BoundModel{}.unknown_mps);
}

// Of an object at 1 m/s whose poses jitter by 0.1 m, without turns.
PastMisses Jittery() {
  PastMisses misses;
  misses.jitter_m2 = 4 * 0.01;
  misses.jitter_count = 3;
  misses.interval_s = 0.2;
  return misses;
}
const Twist kSlow{Eigen::Vector3d::Zero(), {1, 0, 0}};

// What the header says, without misses: q is 1.
TEST(BoundModel, GrowsByJitterVelocityAndAcceleration) {
  const BoundModel model;
  const PositionBound dut = BoundBy(Jittery(), true, kSlow, true);
  const double accel_mps2 = model.rest_accel_mps2 + model.speed_accel_mps2 / 2.5;
  EXPECT_NEAR(dut.at_m, model.factor * model.jitter_gain * 0.1, 1e-9);
  EXPECT_NEAR(dut.speed_mps,
              model.factor * (model.jitter_rate_gain * 0.1 / 0.2 + model.response_s * accel_mps2),
              1e-9);
  EXPECT_NEAR(dut.accel_mps2, model.factor * accel_mps2, 1e-9);
}

// The root mean square of the misses, in expected ones, and of the prior's 1.
double Unpredictability(double prior_count, double weight, double missed) {
  return std::sqrt((prior_count + weight * missed * missed) / (prior_count + weight));
}

void Miss(double expected_m, double missed, Misses& misses) {
  for (int i = 0; i < 5; ++i) misses.Add(std::pow(missed * expected_m, 2));
}

TEST(BoundModel, IsScaledByTheObjectsOwnMisses) {
  const BoundModel model;
  const PositionBound before = BoundBy(Jittery(), true, kSlow, true);
  for (const double missed : {0.0, 0.5, 3.0}) {
    PastMisses misses = Jittery();
    Miss(before.At(1) / model.factor, missed, misses.late[1]);
    const double q = Unpredictability(model.prior_count, 5 * model.late_weight, missed);
    const PositionBound dut = BoundBy(misses, true, kSlow, true);
    EXPECT_NEAR(dut.accel_mps2, q * before.accel_mps2, 1e-5) << missed;
    // Nothing is known of half a second ahead, where noise would show.
    EXPECT_NEAR(dut.at_m, std::max(q, 1.0) * before.at_m, 1e-5) << missed;
  }
}

TEST(BoundModel, SmallMissesFarAheadHideNoNoise) {
  const BoundModel model;
  const PositionBound before = BoundBy(Jittery(), true, kSlow, true);
  PastMisses misses = Jittery();
  Miss(before.At(0.5) / model.factor, 3, misses.late[0]);
  Miss(before.At(3) / model.factor, 0, misses.late[3]);
  const double weight = 5 * model.late_weight;
  const double near = Unpredictability(model.near_prior_count, weight, 3);
  const double all = std::sqrt((model.prior_count + 9 * weight) / (model.prior_count + 2 * weight));
  const PositionBound dut = BoundBy(misses, true, kSlow, true);
  EXPECT_GT(near, 1.2 * all);
  EXPECT_NEAR(dut.at_m, near * before.at_m, 1e-5);
  EXPECT_NEAR(dut.accel_mps2, all * before.accel_mps2, 1e-5);
}

TEST(BoundModel, IsWiderForWhatTurns) {
  const Twist turns{{0, 0, 0.5}, {8, 0, 0}}, straight{Eigen::Vector3d::Zero(), {8, 0, 0}};
  const BoundModel model;
  EXPECT_NEAR(BoundBy({}, true, turns, false).accel_mps2,
              BoundBy({}, true, straight, false).accel_mps2 + model.factor * model.turn_gain * 4,
              1e-9);
}

// The last motion of poses 0.02 s apart magnifies their jitter; a fit to a second of them does not.
TEST(BoundModel, AllowsForJitterBetweenTwoClosePoses) {
  PastMisses misses = Jittery();
  misses.interval_s = 0.02;
  EXPECT_GT(BoundBy(misses, true, kSlow, true).speed_mps,
            BoundBy(misses, true, kSlow, false).speed_mps);
}

TEST(PositionBound, IsFiniteForPosesFarApartOrAtOnce) {
  Random random(4);
  for (const double step_s : {1e-9, 0.01, 0.7, 3.0, 40.0}) {
    std::vector<StampedPose> track;
    for (int k = 0; k < 30; ++k) track.push_back({At(step_s * k), random.AnyPose(5)});
    for (std::size_t size = 2; size <= track.size(); ++size) {
      const PositionBound dut =
          BoundWith({track.begin(), track.begin() + size}, ByTrack(size % 2 ? 0.6 : 0));
      for (const double value : {dut.at_m, dut.speed_mps, dut.accel_mps2}) {
        EXPECT_TRUE(std::isfinite(value));
        EXPECT_GE(value, 0);
      }
    }
  }
}

}  // namespace
}  // namespace clearway
