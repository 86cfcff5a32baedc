// What is said of an object that goes otherwise.
#include "scene/distrusted_motions.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

// A van of 4 x 2 x 2 m that passes the sensor 10 m away at 4 m/s, before a wall.
class DistrustedMotions : public testing::Test {
 protected:
  static constexpr double kSpeed_mps = 4;

  static Frame Showing(double seconds) {
    Frame frame = FrameAt(seconds);
    const Pose T_W_B = Pose::Translation(10, kSpeed_mps * seconds - 6, 0);
    AddObject(frame, 5, T_W_B, BoxSurface({2, 4, 2}, 0.2));
    std::erase_if(frame.points_S, [](const Eigen::Vector3f& p) { return p.x() > 9.01f; });
    frame.labels.assign(frame.points_S.size(), 5);
    const std::vector<Eigen::Vector3f> van_S = frame.points_S;
    for (double y = -20; y < 20; y += 0.4) {
      for (double z = -2; z <= 2; z += 0.4) {
        const double in_van_y = 9 * y / 20, in_van_z = 9 * z / 20;
        const bool is_hidden =
            std::abs(in_van_y - T_W_B.translation.y()) < 2.05 && std::abs(in_van_z) < 1.05;
        if (!is_hidden) AddPoint(frame, kStaticLabel, {20, y, z});
      }
    }
    return frame;
  }
  static void Say(double mps, double since, double seconds, Frame& frame) {
    frame.motions.push_back({5, Pose::Translation(0, mps * (seconds - since), 0), At(since)});
  }
  FrameReport Applied(const Frame& frame) {
    const auto report = dut_.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    return report.ok() ? *report : FrameReport();
  }
  double Length() { return dut_.Publish()->FindObject(5)->solid->box_O.Size().y(); }

  ThreadPool pool_{1};
  SceneBuilder dut_{SceneParams{}, FrameLimits{}, pool_};
};

TEST_F(DistrustedMotions, AreNamedAndItBeginsAnew) {
  std::size_t restarted = 0, left_out = 0;
  for (int k = 0; k < 20; ++k) {
    Frame frame = Showing(0.1 * k);
    if (k > 0) Say(-1, 0.1 * (k - 1), 0.1 * k, frame);
    const FrameReport report = Applied(frame);
    left_out += report.motions_implausible;
    restarted += report.objects_restarted;
    for (const ObjectIssue& issue : report.issues) {
      EXPECT_EQ(issue.id, 5);
      EXPECT_GT(issue.value, issue.limit);
    }
  }
  EXPECT_GE(left_out, 14u);
  EXPECT_EQ(restarted, 1u);
  EXPECT_NEAR(Length(), 4, 0.4);
  EXPECT_NEAR(dut_.Publish()->FindObject(5)->SpeedMps(), kSpeed_mps, 0.3);
}

// Each tells of the time since its own last frame.
TEST_F(DistrustedMotions, OfTwoSensorsInTurnAreFollowed) {
  for (const double mps : {kSpeed_mps, 0.0}) {
    dut_.Reset();
    std::size_t left_out = 0;
    for (int k = 0; k < 40; ++k) {
      const double seconds = 0.1 * (k / 2) + 0.03 * (k % 2);
      Frame frame = Showing(seconds);
      if (k % 2 == 1) frame.sensor_id = "camera";
      if (k > 1) Say(mps, seconds - 0.1, seconds, frame);
      left_out += Applied(frame).motions_implausible;
    }
    EXPECT_EQ(left_out > 20, mps == 0) << left_out;
    EXPECT_NEAR(Length(), 4, 0.5);
  }
}

TEST_F(DistrustedMotions, ThatAreRightAreNotAfterAnotherOneThatWasLeftOut) {
  std::size_t left_out = 0;
  for (int k = 0; k < 20; ++k) {
    Frame frame = Showing(0.1 * k);
    if (k > 0) Say(k == 8 ? 90 : kSpeed_mps, 0.1 * (k - 1), 0.1 * k, frame);
    left_out += Applied(frame).motions_implausible;
  }
  EXPECT_EQ(left_out, 1u);
  EXPECT_NEAR(Length(), 4, 0.4);
}

TEST_F(DistrustedMotions, DoNotDependOnLateFrames) {
  std::size_t left_out = 0;
  for (int k = 0; k < 20; ++k) {
    Frame frame = Showing(0.1 * k);
    if (k > 0) Say(kSpeed_mps, 0.1 * (k - 1), 0.1 * k, frame);
    left_out += Applied(frame).motions_implausible;
    if (k == 0) continue;
    Frame late = Showing(0.1 * k - 0.05);
    late.sensor_id = "camera";
    Say(-kSpeed_mps, 0.1 * (k - 1), 0.1 * k - 0.05, late);
    EXPECT_EQ(Applied(late).motions_ignored, 1u);
  }
  EXPECT_EQ(left_out, 0u);
  EXPECT_NEAR(Length(), 4, 0.4);
}

// It stays where it was predicted, as if nothing were said.
TEST_F(DistrustedMotions, OfWhatIsHiddenCountForNothing) {
  for (int k = 0; k < 10; ++k) {
    Frame frame = Showing(0.1 * k);
    if (k > 0) Say(0, 0.1 * (k - 1), 0.1 * k, frame);
    Applied(frame);
  }
  const double y_m = dut_.Publish()->FindObject(5)->history.back().T_W_O.translation.y();
  Frame hidden = FrameAt(1);
  Say(0, 0.9, 1, hidden);
  EXPECT_EQ(Applied(hidden).motions_implausible, 1u);
  const Pose T_W_O = PredictPose(*dut_.Publish()->FindObject(5), At(1), FromSeconds(9)).T_W_O;
  EXPECT_NEAR(T_W_O.translation.y(), y_m + 0.1 * kSpeed_mps, 0.1);
}

}  // namespace
}  // namespace clearway
