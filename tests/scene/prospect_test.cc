// Which way an object goes on by itself.
#include "scene/prospect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "scene/object_motion.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;
using testing_support::Random;

using Way = std::function<Pose(double t_s)>;

Solid Body() {
  Solid solid;
  solid.box_O = Aabb{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}};
  solid.radius_m = 0.35;
  return solid;
}

std::vector<StampedPose> Track(double seconds, const Way& way) {
  std::vector<StampedPose> track;
  for (int k = 0; k <= std::lround(10 * seconds); ++k) track.push_back({At(0.1 * k), way(0.1 * k)});
  return track;
}

SceneParams By(MotionModel model) {
  SceneParams params;
  params.motion = model;
  return params;
}

Prospect ProspectBy(MotionModel model, std::span<const StampedPose> track) {
  return ProspectOf(track, Time::min(), LastMotionOf(track), Body(), By(model));
}

// Of a pendulum of 1.4 m, to and fro within 1.5 m in 2.6 s.
Pose Swings(double t_s) {
  const double angle_rad = 0.55 * std::sin(2 * M_PI * t_s / 2.6);
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitX())),
          {0, 1.4 * std::sin(angle_rad), -1.4 * std::cos(angle_rad)}};
}

TEST(Prospect, OfWhatSwingsIsItsLastMotion) {
  const auto track = Track(5, Swings);
  EXPECT_EQ(ProspectBy(MotionModel::kTrack, track).velocity_O, LastMotionOf(track));
  EXPECT_EQ(ProspectBy(MotionModel::kTrack, track).bound,
            ProspectBy(MotionModel::kLastMotion, track).bound);
}

TEST(Prospect, OfWhatHasSwungForAMomentIsThatOfItsTrack) {
  const auto track = Track(1.2, Swings);
  EXPECT_EQ(ProspectBy(MotionModel::kTrack, track).velocity_O,
            GoesOnByItself(track, Body(), By(MotionModel::kTrack)));
}

TEST(Prospect, OfWhatIsSeenWithNoiseIsThatOfItsTrack) {
  Random random(2);
  const auto track = Track(8, [&](double t_s) {
    return Pose::Translation(2 * t_s + 0.1 * random.Normal(), 0.1 * random.Normal(), 0);
  });
  EXPECT_EQ(ProspectBy(MotionModel::kTrack, track).velocity_O,
            GoesOnByItself(track, Body(), By(MotionModel::kTrack)));
}

TEST(Prospect, KeepsWhatSwingsWithinItsBound) {
  for (const MotionModel model : {MotionModel::kTrack, MotionModel::kLastMotion}) {
    int within = 0, all = 0;
    for (int k = 20; k <= 80; ++k) {
      const double now_s = 0.1 * k;
      const auto [velocity_O, bound] = ProspectBy(model, Track(now_s, Swings));
      for (const double ahead_s : {0.5, 1.0, 2.0, 3.0}) {
        const Pose predicted = Swings(now_s) * Exp(ahead_s * velocity_O);
        const double error_m = (predicted.translation - Swings(now_s + ahead_s).translation).norm();
        within += error_m <= bound.At(ahead_s);
        ++all;
      }
    }
    EXPECT_GE(within, 0.9 * all);
  }
}

TEST(Prospect, OfOnePoseIsTheMotionThatWasTold) {
  const std::vector<StampedPose> track = {{At(0), Pose()}};
  const Twist told_O{Eigen::Vector3d::Zero(), {3, 0, 0}};
  for (const MotionModel model : {MotionModel::kTrack, MotionModel::kLastMotion}) {
    EXPECT_EQ(ProspectOf(track, At(0), told_O, Body(), By(model)).velocity_O, told_O);
  }
}

}  // namespace
}  // namespace clearway
