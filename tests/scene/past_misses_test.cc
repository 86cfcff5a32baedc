// How far past predictions were off, on tracks of which that is known.
#include "scene/past_misses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "scene/object_motion.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;

Solid Body() {
  Solid solid;
  solid.box_O = {{1, -1, 0}, {3, 1, 2}};
  solid.radius_m = 4;
  return solid;
}

std::vector<StampedPose> Track(int poses, double step_s,
                               const std::function<double(double)>& x_at) {
  std::vector<StampedPose> track;
  for (int k = 0; k < poses; ++k) {
    track.push_back({At(step_s * k), Pose::Translation(x_at(step_s * k), 0, 0)});
  }
  return track;
}

double Accelerates(double t_s) { return 0.5 * 2 * t_s * t_s; }  // 2 m/s^2

PastMisses MissesByLastMotion(const std::vector<StampedPose>& track, Time since = Time::min()) {
  return MissesOf(track, since, Body(), LastMotionOf);
}

// The last motion lags by half a step: it misses by a h^2 / 2 + a step h / 2.
TEST(PastMisses, AreThoseOfThePredictionsMadeThen) {
  const PastMisses dut = MissesByLastMotion(Track(61, 0.1, Accelerates));
  for (const Misses& misses : dut.late) {
    const double missed_m = misses.ahead_s * misses.ahead_s + 0.1 * misses.ahead_s;
    EXPECT_NEAR(misses.sum_m2, misses.count * missed_m * missed_m, 1e-6) << misses.ahead_s;
  }
  EXPECT_EQ(dut.late[0].count, 10);
  EXPECT_EQ(dut.late[1].count, 9);
  EXPECT_EQ(dut.late[2].count, 7);
  EXPECT_EQ(dut.late[3].count, 5);
  ASSERT_FALSE(dut.soon.empty());
  for (const Misses& misses : dut.soon) {
    const double missed_m = misses.ahead_s * misses.ahead_s + 0.1 * misses.ahead_s;
    EXPECT_LT(misses.ahead_s, 0.5);
    EXPECT_NEAR(misses.sum_m2, missed_m * missed_m, 1e-9) << misses.ahead_s;
  }
}

TEST(PastMisses, AreNoneOfTwoPoses) {
  const PastMisses dut = MissesByLastMotion(Track(2, 0.1, Accelerates));
  EXPECT_EQ(dut.late[0].count, 0);
  EXPECT_TRUE(dut.soon.empty());
  EXPECT_EQ(dut.jitter_count, 0);
  EXPECT_NEAR(dut.interval_s, 0.1, 1e-9);
}

TEST(PastMisses, OfOnePoseHaveNoInterval) {
  EXPECT_EQ(MissesByLastMotion(Track(1, 0.1, Accelerates)).interval_s, 0);
}

TEST(PastMisses, LeaveOutWhatWasBefore) {
  const auto track = Track(61, 0.1, Accelerates);
  const PastMisses dut = MissesByLastMotion(track, At(4.95));
  const PastMisses young = MissesByLastMotion({track.begin() + 50, track.end()});
  EXPECT_EQ(dut.late[0].count, young.late[0].count);
  EXPECT_EQ(dut.late[1].count, 0);
  EXPECT_EQ(dut.soon.size(), young.soon.size());
  EXPECT_EQ(dut.jitter_count, young.jitter_count);
}

// Each other pose is 0.2 m off: the line through its neighbours is on the other side.
TEST(PastMisses, MeasureTheJitterOfPoses) {
  const PastMisses dut = MissesByLastMotion(Track(
      61, 0.1, [](double t_s) { return 5 * t_s + (std::lround(10 * t_s) % 2 ? 0.1 : -0.1); }));
  ASSERT_GT(dut.jitter_count, 10);
  EXPECT_NEAR(dut.jitter_m2 / dut.jitter_count, 0.2 * 0.2, 1e-9);
}

// Ten times as many poses are no more evidence.
TEST(PastMisses, CountTheSameAtAnyRate) {
  const PastMisses slow = MissesByLastMotion(Track(61, 0.1, Accelerates));
  const PastMisses fast = MissesByLastMotion(Track(601, 0.01, Accelerates));
  EXPECT_EQ(fast.late[0].count, slow.late[0].count);
  EXPECT_NEAR(static_cast<double>(fast.soon.size()), static_cast<double>(slow.soon.size()),
              0.3 * static_cast<double>(slow.soon.size()));
  EXPECT_NEAR(fast.jitter_count, slow.jitter_count, 3);
}

}  // namespace
}  // namespace clearway
