// Sources that give poses or motions of some frames only, as data sets with keyframes do, and
// points in all.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr double kSpeed_mps = 6;
const Eigen::Vector3d kSize_m(4.4, 1.8, 1.4);

struct Source {
  int every = 5;  // frames there is a pose or motion
  bool as_motions = false;
  double turn_rate_rps = 0;
  MotionModel model = MotionModel::kLastMotion;

  Pose At(int k) const {
    const Twist velocity_B{{0, 0, turn_rate_rps}, {kSpeed_mps, 0, 0}};
    return Pose::Translation(-10, 5, 0.7) * Exp(0.1 * k * velocity_B);
  }
  Frame FrameOf(int k) const {
    Frame frame = FrameAt(0.1 * k);
    AddObject(frame, 5, At(k), BoxSurface(kSize_m, 0.1));
    if (k % every != 0) return frame;
    if (!as_motions) {
      frame.poses.push_back({5, At(k)});
    } else if (k > 0) {
      const Time from = testing_support::At(0.1 * (k - every));
      frame.motions.push_back({5, At(k) * Inverse(At(k - every)), from});
    }
    return frame;
  }
  std::string Text() const {
    return absl::StrCat(every, as_motions ? " motions" : " poses", " turning ", turn_rate_rps,
                        model == MotionModel::kTrack ? " track" : " last motion");
  }
};

// At every keyframe from the second on: its speed, its size and where it goes.
void ExpectRight(const Source& source) {
  SceneParams params;
  params.motion = source.model;
  ThreadPool pool(1);
  SceneBuilder dut(params, {}, pool);
  for (int k = 0; k <= 30; ++k) {
    const auto report = dut.Apply(source.FrameOf(k));
    ASSERT_TRUE(report.ok()) << report.status();
    EXPECT_EQ(report->objects_restarted, 0u) << source.Text() << ", frame " << k;
    if (k % source.every != 0 || k < 2 * source.every) continue;
    const MovingObject& object = *dut.Publish()->FindObject(5);
    EXPECT_NEAR(object.SpeedMps(), kSpeed_mps, 0.3) << source.Text() << ", frame " << k;
    // Before the second keyframe nothing tells that it turns.
    const double turned_rad = 0.1 * source.every * source.turn_rate_rps;
    EXPECT_LT((object.solid->box_O.Size() - kSize_m).maxCoeff(),
              0.35 + kSize_m.x() * std::sin(turned_rad))
        << source.Text() << ", frame " << k;
    const Eigen::Vector3d center_O = object.solid->box_O.Center();
    const Pose later = PredictPose(object, At(0.1 * (k + 10)), params.horizon).T_W_O;
    EXPECT_LT((later * center_O - source.At(k + 10).translation).norm(), 0.5)
        << source.Text() << ", frame " << k;
  }
}

TEST(Keyframes, GiveTheSpeedBetweenThem) {
  for (const int every : {2, 3, 5, 10}) {
    for (const bool as_motions : {false, true}) {
      for (const double turn_rate_rps : {0.0, 0.3}) {
        for (const MotionModel model : {MotionModel::kLastMotion, MotionModel::kTrack}) {
          ExpectRight({every, as_motions, turn_rate_rps, model});
        }
      }
    }
  }
}

}  // namespace
}  // namespace clearway
