#include "scene/sensor_registration.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/rooms.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;
using testing_support::kRoom_W;
using testing_support::Random;
using testing_support::ScanOfRoom;
using testing_support::SeenOfRoom;

constexpr double kRadPerDeg = std::numbers::pi / 180;

SceneParams Mending(double error_m = 0.3, double error_rad = 0.03) {
  SceneParams params;
  params.sensor_pose_error_m = error_m;
  params.sensor_pose_error_rad = error_rad;
  return params;
}

Pose Turned(double degrees, const Eigen::Vector3d& shift) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kRadPerDeg, Eigen::Vector3d::UnitZ())),
          shift};
}

double Apart_m(const Pose& a, const Pose& b) { return (a.translation - b.translation).norm(); }

double Apart_deg(const Pose& a, const Pose& b) {
  return a.rotation.angularDistance(b.rotation) / kRadPerDeg;
}

class SensorInARoom : public testing::Test {
 protected:
  // What was seen from three places.
  static VoxelMap MapOfRoom() {
    VoxelMap map_W(0.1);
    for (const double x_m : {-2.0, 0.0, 2.0}) {
      const Pose T_W_S = Pose::Translation(x_m, 0.3 * x_m, 0.2);
      for (const Eigen::Vector3d& p_S : SeenOfRoom(T_W_S)) {
        map_W.Set(map_W.grid().KeyOf(T_W_S * p_S), 3000);
      }
    }
    return map_W;
  }
  // Where the scan of a source that says T_V_S is put.
  Pose Placed(const Pose& T_V_S, const WorldCorrections& before = WorldCorrections(),
              const SceneParams& params = Mending()) const {
    const Frame frame = ScanOfRoom(1, T_W_S_, T_V_S);
    return RegisterWorld(frame, map_W_, before, params) * T_V_S;
  }

  VoxelMap map_W_ = MapOfRoom();
  Pose T_W_S_ = Turned(25, {0.7, -0.4, 0.1});
};

TEST_F(SensorInARoom, IsPutWhereTheWallsFit) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Pose off = Exp({2 * kRadPerDeg * random.UnitVector(), 0.3 * random.UnitVector()});
    const Pose dut = Placed(T_W_S_ * off);
    EXPECT_LT(Apart_m(dut, T_W_S_), 0.04);
    EXPECT_LT(Apart_deg(dut, T_W_S_), 0.2);
  }
}

TEST_F(SensorInARoom, HardlyMovesWhereItFits) {
  const Pose dut = Placed(T_W_S_);
  EXPECT_LT(Apart_m(dut, T_W_S_), 0.04);
  EXPECT_LT(Apart_deg(dut, T_W_S_), 0.1);
}

TEST_F(SensorInARoom, GoesOnFromTheCorrectionBefore) {
  const Pose T_W_V = Turned(50, {4, 2, 0});
  const Pose T_V_S = Inverse(T_W_V) * T_W_S_;
  EXPECT_GT(Apart_m(Placed(T_V_S), T_W_S_), 0.5);
  WorldCorrections before;
  before.Add(At(0.9), T_W_V * Turned(0.3, {0.03, 0.02, 0}));
  const Pose dut = Placed(T_V_S, before);
  EXPECT_LT(Apart_m(dut, T_W_S_), 0.06);
  EXPECT_LT(Apart_deg(dut, T_W_S_), 0.3);
}

TEST_F(SensorInARoom, IsFoundWhenTheSourceComesBackToTheTruth) {
  WorldCorrections before;
  before.Add(At(0.9), Turned(8, {1.6, 0.9, 0}));
  EXPECT_LT(Apart_m(Placed(T_W_S_, before), T_W_S_), 0.06);
}

// A camera before a wall sees few blocks of it, but many voxels: it is as far from it as it sees.
TEST_F(SensorInARoom, IsFoundByANarrowScan) {
  const Pose T_W_S = Pose::Translation(4.97, 1, 0.5), T_V_S = Pose::Translation(4.75, 1, 0.5);
  VoxelMap map_W(0.1);
  Frame frame = FrameAt(1);
  frame.T_W_S = T_V_S;
  for (double y = 0; y < 2; y += 0.02) {
    for (double z = -0.3; z < 1.3; z += 0.02) {
      const Eigen::Vector3d p_W(kRoom_W.max.x(), y, z);
      map_W.Set(map_W.grid().KeyOf(p_W), 3000);
      AddPoint(frame, kStaticLabel, Inverse(T_W_S) * p_W);
    }
  }
  const Pose dut = RegisterWorld(frame, map_W, WorldCorrections(), Mending()) * T_V_S;
  EXPECT_LT(Apart_m(dut, T_W_S), 0.08);
}

// Nothing tells where a plane is along itself, nor how it is turned about its normal.
TEST(SensorOverFlatGround, KeepsTheSourcesPoseAlongIt) {
  VoxelMap map_W(0.1);
  for (int x = -100; x < 100; ++x) {
    for (int y = -100; y < 100; ++y) map_W.Set({x, y, -10}, 3000);
  }
  Random random(8);
  const Pose T_W_S = Turned(25, {0.7, -0.4, 0.1});
  Frame frame = FrameAt(1);
  frame.T_W_S = Exp({{0.02, -0.01, 0.02}, {0.2, -0.15, 0.12}}) * T_W_S;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d p_W(random.Uniform(-6, 6), random.Uniform(-6, 6), -0.95);
    AddPoint(frame, kStaticLabel, Inverse(T_W_S) * p_W);
  }
  const auto expect_along = [&](const WorldCorrections& before, double tolerance_m) {
    const Pose dut = RegisterWorld(frame, map_W, before, Mending()) * frame.T_W_S;
    EXPECT_NEAR(dut.translation.z(), T_W_S.translation.z(), 0.02);
    EXPECT_LT((dut.translation - frame.T_W_S.translation).head<2>().norm(), tolerance_m);
    const Eigen::Vector3d turned = Log(dut * Inverse(T_W_S)).angular;
    EXPECT_LT(turned.head<2>().norm(), 0.003);
    EXPECT_NEAR(turned.z(), 0.02, 0.003);
  };
  expect_along(WorldCorrections(), 0.1);  // which voxels are hit is chance
  WorldCorrections before;
  before.Add(At(0.9), Pose{});
  expect_along(before, 0.01);
}

TEST_F(SensorInARoom, WithoutAMapIsWhereTheGuessesSay) {
  map_W_ = VoxelMap(0.1);
  EXPECT_EQ(RegisterWorld(ScanOfRoom(1, T_W_S_, T_W_S_), map_W_, WorldCorrections(), Mending()),
            Pose{});
  WorldCorrections before;
  before.Add(At(0.9), Pose::Translation(0.1, 0, 0));
  const double x_m = (Placed(T_W_S_, before).translation - T_W_S_.translation).x();
  EXPECT_LT(x_m, 0.1);
  EXPECT_GT(x_m, 0.09);  // it is forgotten in some seconds
}

TEST_F(SensorInARoom, ByStaticPointsInRangeAlone) {
  const Pose T_V_S = T_W_S_ * Turned(1, {0.1, 0.1, 0});
  Frame frame = ScanOfRoom(1, T_W_S_, T_V_S);
  SceneParams params = Mending();
  params.rays.max_range_m = 20;
  params.self_filter_S = {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}};
  const Pose expected = RegisterWorld(frame, map_W_, WorldCorrections(), params);
  frame.no_return.assign(frame.labels.size(), 0);
  for (int i = 0; i < 3000; ++i) {
    AddPoint(frame, i % 2 == 0 ? 7 : kIgnoreLabel, {1 + 0.001 * i, 2, 0});
    frame.no_return.push_back(0);
    AddPoint(frame, kStaticLabel, {0.1, 0.0001 * i, 0});
    frame.no_return.push_back(0);
    AddPoint(frame, kStaticLabel, {30 + 0.001 * i, 2, 0});
    frame.no_return.push_back(0);
    AddPoint(frame, kStaticLabel, {2, 1 + 0.001 * i, 0});
    frame.no_return.push_back(1);
    AddPoint(frame, kStaticLabel, Eigen::Vector3d::Constant(NAN));
    frame.no_return.push_back(0);
  }
  EXPECT_EQ(RegisterWorld(frame, map_W_, WorldCorrections(), params), expected);
}

// A scene of the room while the source's world V drifts and jumps.
class SceneOfARoom : public testing::Test {
 protected:
  static constexpr int kFrames = 12;

  static Pose TrueT_W_S(int k) { return Turned(2.0 * k, {-1 + 0.1 * k, 0.2, 0.1}); }
  // The first pose is right, as of a SLAM system.
  static Pose TrueT_V_W(int k) {
    const double jump = k >= 6 ? 1 : 0;
    return Turned(0.1 * k + jump, {0.02 * k + 0.15 * jump, -0.2 * jump, 0.01 * k});
  }
  static Frame FrameOf(int k) {
    return ScanOfRoom(0.1 * k, TrueT_W_S(k), TrueT_V_W(k) * TrueT_W_S(k));
  }
  ThreadPool pool_{1};
};

TEST_F(SceneOfARoom, TakesTheFirstFrameAsItIs) {
  SceneBuilder dut(Mending(), {}, pool_), off({}, {}, pool_);
  const Frame frame = FrameOf(3);
  EXPECT_EQ(dut.Apply(frame)->T_W_S, frame.T_W_S);
  ASSERT_TRUE(off.Apply(frame).ok());
  EXPECT_EQ(dut.Publish()->static_map_W, off.Publish()->static_map_W);
}

TEST_F(SceneOfARoom, TakesAllFramesAsTheyAreUnlessTold) {
  SceneBuilder dut({}, {}, pool_);
  for (int k = 0; k < kFrames; ++k) EXPECT_EQ(dut.Apply(FrameOf(k))->T_W_S, FrameOf(k).T_W_S);
}

TEST_F(SceneOfARoom, KeepsTheSensorWhereItTrulyIs) {
  SceneBuilder dut(Mending(), {}, pool_);
  for (int k = 0; k < kFrames; ++k) {
    const Pose T_W_S = dut.Apply(FrameOf(k))->T_W_S.value();
    EXPECT_LT(Apart_m(T_W_S, TrueT_W_S(k)), 0.06) << k;
    EXPECT_LT(Apart_deg(T_W_S, TrueT_W_S(k)), 0.3) << k;
  }
}

TEST_F(SceneOfARoom, FindsItselfInAPrior) {
  SceneBuilder mapper({}, {}, pool_);
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(mapper.Apply(ScanOfRoom(0.1 * k, TrueT_W_S(k), TrueT_W_S(k))).ok());
  }
  SceneBuilder dut(Mending(), {}, pool_);
  ASSERT_TRUE(dut.LoadPrior(mapper.Publish()->static_map_W).ok());
  const Frame frame = ScanOfRoom(1, TrueT_W_S(5), TrueT_W_S(5) * Turned(1, {0.2, 0.1, 0.1}));
  EXPECT_LT(Apart_m(dut.Apply(frame)->T_W_S.value(), TrueT_W_S(5)), 0.06);
}

// Told by its poses and by its motions: in the room it stands still, in the source's world it does
// not.
TEST_F(SceneOfARoom, AnObjectThatStandsStillStaysAtRest) {
  const Pose T_W_B = Turned(30, {3, 1, 0});
  for (const bool by_motions : {false, true}) {
    SceneBuilder dut(Mending(), {}, pool_);
    for (int k = 0; k < kFrames; ++k) {
      Frame frame = FrameOf(k);
      AddObject(frame, 5, TrueT_V_W(k) * T_W_B, BoxSurface({1, 1, 1}, 0.1));
      if (!by_motions) {
        frame.poses.push_back({5, TrueT_V_W(k) * T_W_B});
      } else if (k > 0) {
        const Pose H_V = TrueT_V_W(k) * Inverse(TrueT_V_W(k - 1));
        frame.motions.push_back({5, H_V, At(0.1 * (k - 1))});
      }
      ASSERT_TRUE(dut.Apply(frame).ok());
    }
    const MovingObject& object = *dut.Publish()->FindObject(5);
    ASSERT_EQ(object.history.size(), kFrames);
    for (const StampedPose& pose : object.history) {
      EXPECT_LT(Apart_m(pose.T_W_O, object.history.front().T_W_O), 0.07) << by_motions;
      EXPECT_LT(Apart_deg(pose.T_W_O, object.history.front().T_W_O), 0.3) << by_motions;
    }
  }
}

TEST_F(SceneOfARoom, DoesNotDependOnTheNumberOfThreads) {
  std::set<std::string> hashes;
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    SceneBuilder dut(Mending(), {}, pool);
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(dut.Apply(FrameOf(k)).ok());
    hashes.insert(dut.Publish()->Hash());
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST_F(SceneOfARoom, ForgetsItsCorrectionsWithTheRest) {
  SceneBuilder dut(Mending(), {}, pool_);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(dut.Apply(FrameOf(k)).ok());
  dut.Reset();
  const Frame frame = FrameOf(4);
  EXPECT_EQ(dut.Apply(frame)->T_W_S, frame.T_W_S);
}

// Objects are placed by the first of them.
TEST_F(SceneOfARoom, IsCorrectedOnceForAllSensorsOfOneStamp) {
  SceneBuilder dut(Mending(), {}, pool_);
  for (int k = 0; k < kFrames; ++k) {
    const Frame frame = FrameOf(k);
    Frame other = frame;
    other.T_W_S = other.T_W_S * Pose::Translation(0.1, 0, 0);  // badly calibrated
    const Pose T_W_V = dut.Apply(frame)->T_W_S.value() * Inverse(frame.T_W_S);
    EXPECT_LT(Apart_m(dut.Apply(other)->T_W_S.value(), T_W_V * other.T_W_S), 1e-9);
  }
}

TEST_F(SceneOfARoom, ARefusedFrameCorrectsNothing) {
  FrameLimits few;
  few.max_objects = 5;
  SceneBuilder dut(Mending(), few, pool_), other(Mending(), few, pool_);
  for (int k = 0; k < kFrames; ++k) {
    Frame refused = FrameOf(k);
    for (ObjectId id = 50; id < 60; ++id) AddPoint(refused, id, {1, 0.1 * id, 0});
    EXPECT_EQ(dut.Apply(refused).status().code(), absl::StatusCode::kResourceExhausted);
    EXPECT_EQ(dut.Apply(FrameOf(k))->T_W_S, other.Apply(FrameOf(k))->T_W_S);
  }
}

}  // namespace
}  // namespace clearway
