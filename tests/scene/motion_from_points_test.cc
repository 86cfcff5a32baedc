#include "scene/motion_from_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr double kPeriod_s = 0.1;
using Way = std::function<Pose(double seconds)>;

Pose Upright(double x_m, double y_m, double z_m, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())),
          {x_m, y_m, z_m}};
}

class MotionFromPointsTest : public testing::Test {
 protected:
  SceneBuilder Builder(MotionFromPoints mode = MotionFromPoints::kAuto) {
    SceneParams params;
    params.motion_from_points = mode;
    return SceneBuilder(params, FrameLimits(), pool_);
  }
  // The sides of the box that face the sensor, which is at the world's origin.
  static void AddVisible(Frame& frame, ObjectId id, const Pose& T_W_B,
                         const Eigen::Vector3d& size_m) {
    const Pose T_S_W = Inverse(frame.T_W_S);
    const Eigen::Vector3d sensor_B = Inverse(T_W_B) * frame.T_W_S.translation;
    for (const Eigen::Vector3d& p_B : BoxSurface(size_m, 0.15)) {
      for (int axis = 0; axis < 3; ++axis) {
        const bool on_side = std::abs(p_B[axis]) > size_m[axis] / 2 - 1e-6;
        if (!on_side || p_B[axis] * (sensor_B[axis] - p_B[axis]) <= 0) continue;
        AddPoint(frame, id, T_S_W * (T_W_B * p_B));
        break;
      }
    }
  }
  struct Errors {
    double position_m = 0, speed_mps = 0, size_m = 0;
  };
  // Shows the box on its way, without motions; what is wrong after so many frames.
  Errors Follow(
      SceneBuilder& dut, const Way& way, const Eigen::Vector3d& size_m, int frames,
      const Way& sensor = [](double) { return Pose(); }) {
    Pose T_O_B;
    for (int k = 0; k < frames; ++k) {
      Frame frame = FrameAt(k * kPeriod_s);
      frame.T_W_S = sensor(k * kPeriod_s);
      AddVisible(frame, 1, way(k * kPeriod_s), size_m);
      const auto report = dut.Apply(frame);
      EXPECT_TRUE(report.ok()) << report.status();
      EXPECT_EQ(report->objects_restarted, 0u) << k;
      if (k == 0) T_O_B = Inverse(dut.Publish()->objects[0]->history.back().T_W_O) * way(0);
    }
    const MovingObject& object = *dut.Publish()->objects[0];
    const double now_s = (frames - 1) * kPeriod_s;
    const Pose T_W_B = object.history.back().T_W_O * T_O_B;
    // The speed at B's origin.
    const Pose next = object.history.back().T_W_O * Exp(0.01 * object.velocity_O.value_or(Twist{}));
    const Eigen::Vector3d velocity = ((next * T_O_B).translation - T_W_B.translation) / 0.01;
    const Eigen::Vector3d truth = (way(now_s + 0.01).translation - way(now_s).translation) / 0.01;
    return {(T_W_B.translation - way(now_s).translation).norm(), (velocity - truth).norm(),
            (object.solid->box_O.Size() - size_m).cwiseMax(0).maxCoeff()};
  }
  ThreadPool pool_{1};
};

const Eigen::Vector3d kCar(4.2, 1.8, 1.5);

TEST_F(MotionFromPointsTest, ACarThatPasses) {
  for (const double speed_mps : {3.0, 8.0, 14.0}) {
    SceneBuilder dut = Builder();
    const Way way = [&](double t) { return Upright(-12 + speed_mps * t, 6, 0, 0); };
    const Errors errors = Follow(dut, way, kCar, static_cast<int>(20 / speed_mps / kPeriod_s));
    EXPECT_LT(errors.position_m, 0.4) << speed_mps;
    EXPECT_LT(errors.speed_mps, 0.6) << speed_mps;
    EXPECT_LT(errors.size_m, 0.5) << speed_mps;
    EXPECT_EQ(dut.Publish()->objects[0]->pose_source(), PoseSource::kEstimated);
  }
}

TEST_F(MotionFromPointsTest, ACarThatTurns) {
  SceneBuilder dut = Builder();
  const Way way = [](double t) {
    return Upright(10 + 8 * std::sin(0.5 * t), 8 - 8 * std::cos(0.5 * t), 0, 0.5 * t);
  };
  const Errors errors = Follow(dut, way, kCar, 25);
  EXPECT_LT(errors.position_m, 0.5);
  EXPECT_LT(errors.speed_mps, 0.8);
  EXPECT_LT(errors.size_m, 0.5);
}

TEST_F(MotionFromPointsTest, AParkedCarThatTheSensorPasses) {
  SceneBuilder dut = Builder();
  const Errors errors = Follow(
      dut, [](double) { return Upright(10, 5, 0, 0); }, kCar, 25,
      [](double t) { return Pose::Translation(8 * t, 0, 0); });
  EXPECT_LT(errors.position_m, 0.3);
  EXPECT_LT(errors.speed_mps, 0.4);
  EXPECT_LT(errors.size_m, 0.5);
}

// Which side is seen changes when it passes: of what is narrow that looks like a step of half its
// width.
TEST_F(MotionFromPointsTest, APedestrian) {
  SceneBuilder dut = Builder();
  const Way way = [](double t) { return Upright(8, -3 + 1.4 * t, 0, 0); };
  const Errors errors = Follow(dut, way, {0.6, 0.6, 1.7}, 40);
  EXPECT_LT(errors.position_m, 0.45);
  EXPECT_LT(errors.speed_mps, 0.3);
  EXPECT_LT(errors.size_m, 0.45);
}

TEST_F(MotionFromPointsTest, ACarThatClimbs) {
  SceneBuilder dut = Builder();
  const Way way = [](double t) { return Upright(-12 + 8 * t, 6, 0.8 * t, 0); };
  const Errors errors = Follow(dut, way, kCar, 30);
  EXPECT_LT(errors.position_m, 0.4);
  EXPECT_LT(errors.speed_mps, 0.6);
  EXPECT_LT(errors.size_m, 0.5);
}

// Where the sensor is near, points are denser: the middle of all of them stays beside the sensor.
TEST_F(MotionFromPointsTest, ATruckWhoseSideIsDenserWhereItIsNear) {
  const Eigen::Vector3d size_m(8, 2.5, 3);
  SceneBuilder dut = Builder();
  Pose T_O_B;
  Pose T_W_B;
  for (int k = 0; k < 40; ++k) {
    T_W_B = Upright(-30 + 1.5 * k, 4, 0, 0);
    Frame sparse = FrameAt(k * kPeriod_s), frame = FrameAt(k * kPeriod_s);
    AddVisible(sparse, 1, T_W_B, size_m);
    for (const Eigen::Vector3f& p_S : sparse.points_S) {
      const int copies = 1 + static_cast<int>(200 / p_S.squaredNorm());
      for (int i = 0; i < copies; ++i) AddPoint(frame, 1, p_S.cast<double>());
    }
    ASSERT_TRUE(dut.Apply(frame).ok());
    if (k == 0) T_O_B = Inverse(dut.Publish()->objects[0]->history.back().T_W_O) * T_W_B;
  }
  const MovingObject& object = *dut.Publish()->objects[0];
  EXPECT_LT((object.history.back().T_W_O * T_O_B * Inverse(T_W_B)).translation.norm(), 0.6);
  EXPECT_LT(((*object.solid).box_O.Size() - size_m).maxCoeff(), 0.75);
}

TEST_F(MotionFromPointsTest, TheSecondSightGivesAVelocity) {
  SceneBuilder dut = Builder();
  const Way way = [](double t) { return Upright(10 + 12 * t, 5, 0, 0); };
  const Errors errors = Follow(dut, way, kCar, 2);
  EXPECT_LT(errors.position_m, 0.2);
  EXPECT_LT(errors.speed_mps, 2);
}

TEST_F(MotionFromPointsTest, AFirstSightHasNone) {
  SceneBuilder dut = Builder();
  Follow(
      dut, [](double) { return Upright(10, 5, 0, 0); }, kCar, 1);
  EXPECT_FALSE(dut.Publish()->objects[0]->velocity_O.has_value());
  EXPECT_EQ(dut.Publish()->objects[0]->pose_source(), PoseSource::kFirstSight);
}

// One motion, and then none.
TEST_F(MotionFromPointsTest, AutoLeavesObjectsThatHadAMotionToPrediction) {
  for (const auto mode : {MotionFromPoints::kAuto, MotionFromPoints::kOn, MotionFromPoints::kOff}) {
    SceneBuilder dut = Builder(mode);
    for (int k = 0; k < 4; ++k) {
      Frame frame = FrameAt(k * kPeriod_s);
      AddVisible(frame, 1, Upright(10 + 0.2 * k, 5, 0, 0), kCar);
      if (k == 1) frame.motions.push_back({1, Pose::Translation(0.2, 0, 0), At(0)});
      ASSERT_TRUE(dut.Apply(frame).ok());
    }
    EXPECT_EQ(dut.Publish()->objects[0]->pose_source(),
              mode == MotionFromPoints::kOn ? PoseSource::kEstimated : PoseSource::kBridged);
  }
}

TEST_F(MotionFromPointsTest, AReportedMotionCountsAgainAtOnce) {
  SceneBuilder dut = Builder();
  Follow(
      dut, [](double t) { return Upright(10 + 5 * t, 5, 0, 0); }, kCar, 10);
  Frame frame = FrameAt(1.0);
  AddVisible(frame, 1, Upright(15, 5, 0, 0), kCar);
  frame.motions.push_back({1, Pose::Translation(0.5, 0, 0), At(0.9)});
  ASSERT_TRUE(dut.Apply(frame).ok());
  EXPECT_EQ(dut.Publish()->objects[0]->pose_source(), PoseSource::kReported);
  EXPECT_NEAR(dut.Publish()->objects[0]->SpeedMps(), 5, 1e-6);
}

TEST_F(MotionFromPointsTest, TheReportCounts) {
  SceneBuilder dut = Builder();
  std::size_t estimated = 0, bridged = 0;
  for (int k = 0; k < 5; ++k) {
    Frame frame = FrameAt(k * kPeriod_s);
    AddVisible(frame, 1, Upright(10 + 0.5 * k, 5, 0, 0), kCar);
    const auto report = dut.Apply(frame);
    ASSERT_TRUE(report.ok());
    estimated += report->objects_estimated;
    bridged += report->objects_bridged;
  }
  EXPECT_EQ(estimated, 4u);
  EXPECT_EQ(bridged, 0u);
}

}  // namespace
}  // namespace clearway
