// Objects whose views are registered and that go out of sight, while the source tells motions of
// them that are off.
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;
using testing_support::Random;

constexpr double kSigma_m = 0.3;  // of each axis of a motion
constexpr int kSeen = 20, kHidden = 15, kAgain = 15;

Pose Truth(int k) { return Pose::Translation(6 + 0.4 * k, 3, 0.5); }

bool InSight(int k) { return k < kSeen || k >= kSeen + kHidden; }

struct Outcome {
  double hidden_off_m = 0, again_off_m = 0;  // when it was hidden last, and at the end
};

// Whether a motion's error is its own, or that of the two poses it leads between.
enum class Errors { kOfMotions, kOfPoses };

Outcome Follow(std::uint64_t seed, double said_error_m, Errors errors = Errors::kOfMotions) {
  SceneParams params;
  params.object_pose_error_m = said_error_m;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  Random random(seed);
  const auto surface = BoxSurface({4, 1.8, 1.5}, 0.12);
  const auto place_W = [&]() -> Eigen::Vector3d {
    return builder.Publish()->FindObject(5)->history.back().T_W_O.translation;
  };
  Eigen::Vector3d o_B = Eigen::Vector3d::Zero();  // O's origin
  const auto off_m = [&](int k) { return (Truth(k) * o_B - place_W()).norm(); };
  Outcome outcome;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int k = 0; k < kSeen + kHidden + kAgain; ++k) {
    Frame frame = FrameAt(0.1 * k);
    if (InSight(k)) AddObject(frame, 5, Truth(k), surface);
    const Eigen::Vector3d noise(random.Normal(), random.Normal(), random.Normal());
    Pose H_W;
    H_W.translation = Eigen::Vector3d(0.4, 0, 0) + kSigma_m * (noise - before);
    if (errors == Errors::kOfPoses) before = noise;
    if (k > 0) frame.motions.push_back({5, H_W, At(0.1 * (k - 1))});
    EXPECT_TRUE(builder.Apply(frame).ok());
    if (k == 0) o_B = Inverse(Truth(0)) * place_W();
    if (k == kSeen + kHidden - 1) outcome.hidden_off_m = off_m(k);
  }
  outcome.again_off_m = off_m(kSeen + kHidden + kAgain - 1);
  return outcome;
}

TEST(HiddenObject, IsLedByItsTrackAndFoundAgain) {
  constexpr int kRuns = 12;
  double led_off_m = 0, told_off_m = 0;
  int found = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Outcome registered = Follow(run + 1, 0.5);
    led_off_m += registered.hidden_off_m / kRuns;
    told_off_m += Follow(run + 1, 0).hidden_off_m / kRuns;
    found += registered.again_off_m < 0.2;
  }
  EXPECT_GT(told_off_m, 1);  // the noise adds up
  EXPECT_LT(led_off_m, 0.75 * told_off_m);
  EXPECT_GE(found, kRuns - 2);
}

// What one motion has wrong the next one makes good: the source never loses it.
TEST(HiddenObject, IsNotLostWhereErrorsDoNotAddUp) {
  constexpr int kRuns = 12;
  int near = 0, found = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Outcome registered = Follow(run + 1, 0.5, Errors::kOfPoses);
    near += registered.hidden_off_m < 1.2;
    found += registered.again_off_m < 0.2;
  }
  EXPECT_EQ(near, kRuns);
  EXPECT_EQ(found, kRuns);
}

}  // namespace
}  // namespace clearway
