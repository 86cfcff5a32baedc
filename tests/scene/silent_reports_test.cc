// Sources whose motions or poses of an object end, while its points go on.
#include <gtest/gtest.h>

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

const Eigen::Vector3d kCar_m(4.4, 1.8, 1.4), kPerson_m(0.5, 0.5, 1.7);

// Along x at one speed until the reports end and at another from then on.
struct Source {
  Eigen::Vector3d size_m = kCar_m;
  double before_mps = 0, after_mps = 0;
  int reports = 11;  // the first so many frames give a pose or motion
  bool as_motions = false;

  Pose At(int k) const {
    const int last = reports - 1;
    const double x_m =
        k <= last ? before_mps * 0.1 * k : before_mps * 0.1 * last + after_mps * 0.1 * (k - last);
    return Pose::Translation(x_m - 10, 5, 0.5 * size_m.z());
  }
  Frame FrameOf(int k) const {
    Frame frame = FrameAt(0.1 * k);
    AddObject(frame, 5, At(k), BoxSurface(size_m, 0.1));
    if (k >= reports) return frame;
    if (!as_motions) {
      frame.poses.push_back({5, At(k)});
    } else if (k > 0) {
      frame.motions.push_back({5, At(k) * Inverse(At(k - 1)), testing_support::At(0.1 * (k - 1))});
    }
    return frame;
  }
  std::string Text() const {
    return absl::StrCat(size_m.x(), " m long, ", before_mps, " to ", after_mps, " m/s after ",
                        reports, as_motions ? " motions" : " poses");
  }
};

// How far the middle of its solid is from where it will be.
double MissedBy(const Source& source, int k, int ahead, const MovingObject& object) {
  const Pose T_W_O = PredictPose(object, At(0.1 * (k + ahead)), SceneParams().horizon).T_W_O;
  const Eigen::Vector3d center_O = object.solid->box_O.Center();
  return (T_W_O * center_O - source.At(k + ahead).translation).norm();
}

// From a second after the last report on.
void ExpectFollowed(const Source& source) {
  ThreadPool pool(1);
  SceneBuilder dut(SceneParams(), {}, pool);
  for (int k = 0; k < source.reports + 20; ++k) {
    const auto report = dut.Apply(source.FrameOf(k));
    ASSERT_TRUE(report.ok()) << report.status();
    if (k < source.reports + 10) continue;
    EXPECT_EQ(report->objects_estimated, 1u) << source.Text() << ", frame " << k;
    const MovingObject& object = *dut.Publish()->FindObject(5);
    EXPECT_NEAR(object.SpeedMps(), source.after_mps, 0.5) << source.Text() << ", frame " << k;
    EXPECT_LT(MissedBy(source, k, 10, object), 0.5) << source.Text() << ", frame " << k;
    EXPECT_LT((object.solid->box_O.Size() - source.size_m).maxCoeff(), 0.5)
        << source.Text() << ", frame " << k;
  }
}

TEST(SilentReports, AnObjectThatSetsOutIsFollowed) {
  for (const bool as_motions : {false, true}) {
    for (const double after_mps : {1.4, 4.0, 8.0, 12.0}) {
      ExpectFollowed({.after_mps = after_mps, .as_motions = as_motions});
    }
    ExpectFollowed({.size_m = kPerson_m, .after_mps = 1.4, .as_motions = as_motions});
  }
}

TEST(SilentReports, AnObjectThatStopsIsFollowed) {
  for (const bool as_motions : {false, true}) {
    for (const double before_mps : {2.0, 4.0, 6.0}) {
      ExpectFollowed({.before_mps = before_mps, .as_motions = as_motions});
    }
  }
}

TEST(SilentReports, OfOnePoseAloneNoSpeedFollows) {
  ExpectFollowed({.after_mps = 6, .reports = 1});
}

// When they come back, they tell how the object moved, and not from where it was estimated.
TEST(SilentReports, WhatWasEstimatedIsForgottenWhenTheyComeBack) {
  for (const int silent : {8, 15, 25}) {
    const Source source{.before_mps = 6, .after_mps = 6};
    ThreadPool pool(1);
    SceneBuilder dut(SceneParams(), {}, pool);
    for (int k = 0; k <= source.reports + silent; ++k) {
      Frame frame = source.FrameOf(k);
      const bool is_back = k == source.reports + silent;
      if (is_back) frame.poses.push_back({5, source.At(k)});
      ASSERT_TRUE(dut.Apply(frame).ok());
      if (!is_back) continue;
      const MovingObject& object = *dut.Publish()->FindObject(5);
      EXPECT_NEAR(object.SpeedMps(), 6, 1e-6) << silent;
      EXPECT_LT(MissedBy(source, k, 10, object), 0.2) << silent;
    }
  }
}

// A future that somebody stated counts, whatever the points say.
TEST(SilentReports, WhatIsStatedIsNotEstimated) {
  const Source source{.after_mps = 1.5};
  ThreadPool pool(1);
  SceneBuilder dut(SceneParams(), {}, pool);
  for (int k = 0; k < source.reports + 15; ++k) {
    const auto report = dut.Apply(source.FrameOf(k));
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->objects_estimated, 0u) << k;
    if (k != source.reports) continue;
    const Pose T_W_O = dut.Publish()->FindObject(5)->LastPose().T_W_O;
    ASSERT_TRUE(dut.SetFuture(5, {{At(61), Pose::Translation(60, 0, 0) * T_W_O}}).ok());
  }
}

}  // namespace
}  // namespace clearway
