// Two sensors, one of whose frames come after newer ones of the other.
#include "scene/late_frame.h"

#include <gtest/gtest.h>

#include <string>

#include "clearway/scene/occupancy.h"
#include "clearway/scene/scene_delta.h"
#include "scene/sensor_frames.h"
#include "support/wall_scans.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;
using testing_support::RandomFrames;

using LateFrame = SensorFrames;

TEST_F(LateFrame, EveryFrameOfTwoInterleavedSensorsIsApplied) {
  for (int k = 0; k < 20; ++k) {
    Apply(PointAt("front", 1 + 0.1 * k, {5, 0, 0.5}));
    const FrameReport rear = Apply(PointAt("rear", 0.99 + 0.1 * k, {-5, 0, 0.5}));
    EXPECT_EQ(rear.points_used, 1u);
    EXPECT_EQ(scene_->stamp, At(1 + 0.1 * k));
  }
  EXPECT_EQ(Static({5, 0, 0.5}), VoxelState::kOccupied);
  EXPECT_EQ(Static({-5, 0, 0.5}), VoxelState::kOccupied);
}

TEST_F(LateFrame, ItsRaysAndStaticPointsMakeTheMapThatTheyMakeInOrder) {
  Frame late = PointAt("rear", 0.95, {-4, 1, 0.5});
  late.T_W_S = Pose::Translation(0.3, 0.2, 0);
  Apply(PointAt("front", 0.9, {5, 0, 0.5}));
  Apply(PointAt("front", 1.0, {5, 0.1, 0.5}));
  Apply(late);
  SceneBuilder in_order(params_, limits_, pool_);
  ASSERT_TRUE(in_order.Apply(PointAt("front", 0.9, {5, 0, 0.5})).ok());
  ASSERT_TRUE(in_order.Apply(late).ok());
  ASSERT_TRUE(in_order.Apply(PointAt("front", 1.0, {5, 0.1, 0.5})).ok());
  EXPECT_EQ(scene_->Hash(), in_order.Publish()->Hash());
}

// Object 1, a box that goes along x at 10 m/s and is at the origin at 1 s; `front` reports its
// motions.
class LateObject : public SensorFrames {
 protected:
  static constexpr double kSpeed_mps = 10;
  static Pose T_W_B(double seconds) {
    return Pose::Translation(kSpeed_mps * (seconds - 1) + 0.05, 0.05, 0.05);
  }
  static Frame Sight(const std::string& sensor, double seconds) {
    Frame frame = Of(sensor, FrameAt(seconds));
    frame.T_W_S = Pose::Translation(0, -6, 0);
    AddObject(frame, 1, T_W_B(seconds), BoxSurface({2, 1, 1}, 0.2));
    return frame;
  }
  static Frame WithMotion(Frame frame, double step_s = 0.1) {
    frame.motions = {
        {1, Pose::Translation(kSpeed_mps * step_s, 0, 0), frame.stamp - FromSeconds(step_s)}};
    return frame;
  }
  static Frame WithPose(Frame frame) {
    frame.poses = {{1, T_W_B(ToSeconds(frame.stamp.time_since_epoch()))}};
    return frame;
  }
  void Track() {
    for (int k = 0; k <= 5; ++k) Apply(WithMotion(Sight("front", 1 + 0.1 * k)));
  }
};

TEST_F(LateObject, ItsPointsGoWhereItWasThen) {
  Track();
  const MovingObject before = Object(1);
  const FrameReport report = Apply(Sight("rear", 1.45));  // half a metre back
  const MovingObject& after = Object(1);
  EXPECT_EQ(report.objects_created + report.objects_dropped, 0u);
  EXPECT_EQ(after.frames_seen, before.frames_seen + 1);
  EXPECT_EQ(after.history, before.history);
  EXPECT_EQ(after.velocity_O, before.velocity_O);
  EXPECT_EQ(after.last_seen, At(1.5));
  EXPECT_LE((after.observed_box_O.Size() - before.observed_box_O.Size()).maxCoeff(), 0.11);
  EXPECT_EQ(after.map_O.occupied_count(), before.map_O.occupied_count());
}

TEST_F(LateObject, BeforeItsFirstPoseItsVelocityLeadsBack) {
  Apply(WithMotion(Sight("front", 1)));
  const Aabb before_O = Object(1).observed_box_O;
  Apply(Sight("rear", 0.9));
  EXPECT_LE((Object(1).observed_box_O.Size() - before_O.Size()).maxCoeff(), 0.11);
  EXPECT_EQ(Object(1).t_k(), At(1));
}

TEST_F(LateObject, BeforeItsFirstPoseAPoseOfItsBoxSaysWhereItWas) {
  Apply(WithPose(Sight("front", 1)));
  const Aabb before_O = Object(1).observed_box_O;
  Apply(WithPose(Sight("rear", 0.9)));
  EXPECT_LE((Object(1).observed_box_O.Size() - before_O.Size()).maxCoeff(), 0.11);
}

TEST_F(LateObject, ItsMotionIsIgnoredAndCounted) {
  Track();
  const MovingObject before = Object(1);
  Frame late = WithMotion(Of("rear", FrameAt(1.45)));
  late.motions[0].H_W = Pose::Translation(0, 5, 0);
  EXPECT_EQ(Apply(late).motions_ignored, 1u);
  EXPECT_EQ(Object(1).history, before.history);
  EXPECT_EQ(Object(1).frames_seen, before.frames_seen);
}

TEST_F(LateObject, OneThatOnlyTheLateSensorSeesMovesAsUsual) {
  for (int k = 0; k <= 5; ++k) {
    Apply(Of("front", FrameAt(1 + 0.1 * k)));
    const FrameReport report = Apply(WithMotion(Sight("rear", 0.99 + 0.1 * k)));
    EXPECT_EQ(report.motions_ignored, 0u);
    EXPECT_EQ(report.objects_created, k == 0 ? 1u : 0u);
  }
  EXPECT_EQ(Object(1).t_k(), At(1.49));
  EXPECT_NEAR(Object(1).SpeedMps(), kSpeed_mps, 1e-9);
  EXPECT_EQ(Object(1).frames_seen, 6);
  EXPECT_LE((Object(1).observed_box_O.Size() - Eigen::Vector3d(2, 1, 1)).maxCoeff(), 0.31);
}

TEST_F(LateObject, BothSensorsWithMotionsOfTheirOwnMakeOneBox) {
  for (int k = 0; k <= 10; ++k) {
    Apply(WithMotion(Sight("front", 1 + 0.1 * k)));
    Apply(WithMotion(Sight("rear", 0.95 + 0.1 * k)));
  }
  EXPECT_EQ(scene_->objects.size(), 1u);
  EXPECT_LE((Object(1).observed_box_O.Size() - Eigen::Vector3d(2, 1, 1)).maxCoeff(), 0.31);
  EXPECT_NEAR(Object(1).SpeedMps(), kSpeed_mps, 1e-9);
}

TEST_F(LateObject, ACompletedHullKnowsItsDirection) {
  params_.solid = SolidMode::kCompletedHull;
  SetUp();
  for (int k = 0; k <= 12; ++k) Apply(WithMotion(Sight("front", 1 + 0.1 * k)));
  ASSERT_TRUE(Object(1).completion.has_value());
  Apply(Sight("rear", 2.15));
  ASSERT_TRUE(Object(1).completion.has_value());
  EXPECT_NEAR(Object(1).completion->yaw_rad, 0, 1e-3);
}

TEST_F(LateObject, RaysOfTheLateFrameClearTheObjectWhereItWasThen) {
  params_.clear_objects_by_rays = true;
  SetUp();
  Track();
  const auto before = Object(1).map_O.occupied_count();
  Apply(Sight("rear", 1.45));
  EXPECT_EQ(Object(1).map_O.occupied_count(), before);
}

TEST_F(LateObject, AGivenObjectIsNotMovedBack) {
  GivenObject given;
  given.id = 7;
  given.shape = Sphere{0.5};
  given.pose = {At(2), Pose::Translation(3, 3, 0)};
  Apply(Of("front", FrameAt(2)));
  ASSERT_TRUE(dut_->AddObject(given).ok());
  Frame late = Of("rear", FrameAt(1.95));
  AddPoint(late, 7, {3, 3, 0});
  late.motions = {{7, Pose::Translation(1, 0, 0), At(1.8)}};
  const FrameReport report = Apply(late);
  EXPECT_EQ(report.motions_ignored, 1u);
  EXPECT_EQ(report.points_given, 1u);
  EXPECT_EQ(Object(7).t_k(), At(2));
}

// An aerial that was not seen before, half of whose points are labelled static: no label is
// outvoted. That they are the object's shows where it was then.
TEST_F(LateObject, StaticPointsInItAreForgottenAtOnce) {
  params_.filter_labels = true;
  SetUp();
  Track();
  Frame late = Sight("rear", 1.45);
  const Eigen::Vector3d aerial_W = T_W_B(1.45) * Eigen::Vector3d(0.2, -0.5, 1.2);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d p_W = aerial_W + Eigen::Vector3d(0.004 * i, 0, 0);
    AddPoint(late, i % 2 == 0 ? 1 : kStaticLabel, Inverse(late.T_W_S) * p_W);
  }
  EXPECT_EQ(Apply(late).points_doubted, 0u);
  EXPECT_EQ(Static(aerial_W), VoxelState::kUnknown);
}

// Dynamic space on.
class LateWall : public SensorFrames {
 protected:
  LateWall() { params_.dynamic_life = std::chrono::milliseconds(450); }
  void KnowFree() {
    for (int k = 0; k < 10; ++k) Apply(testing_support::ScanOfWall(0.1 * k, std::nullopt));
  }
};

TEST_F(LateWall, ARayDoesNotFreeWhatWasHitLater) {
  KnowFree();
  const testing_support::Panel panel{5, 0};
  Apply(testing_support::ScanOfWall(1.0, panel));
  const auto dynamic = scene_->dynamic_W.voxels().size();
  ASSERT_GT(dynamic, 0u);
  Apply(Of("rear", testing_support::ScanOfWall(0.95, std::nullopt)));
  EXPECT_EQ(scene_->dynamic_W.voxels().size(), dynamic);
  EXPECT_EQ(SceneAtTime(*scene_, scene_->stamp).At(panel.Middle()).status, SpaceStatus::kOccupied);
  Apply(Of("rear", testing_support::ScanOfWall(1.05, std::nullopt)));
  EXPECT_EQ(SceneAtTime(*scene_, scene_->stamp).At(panel.Middle()).status, SpaceStatus::kFree);
}

TEST_F(LateWall, AHitDoesNotMakeTheLastHitOlder) {
  KnowFree();
  const testing_support::Panel panel{5, 0};
  Apply(testing_support::ScanOfWall(1.0, panel));
  Apply(Of("rear", testing_support::ScanOfWall(0.95, panel)));
  for (const DynamicVoxel& voxel : scene_->dynamic_W.voxels()) {
    EXPECT_EQ(voxel.last_hit, At(1));
    EXPECT_LE(voxel.first_hit, voxel.last_hit);
  }
}

// What must hold of any scene.
void ExpectOrdered(const SceneSnapshot& scene) {
  for (const auto& object : scene.objects) {
    for (std::size_t i = 1; i < object->history.size(); ++i) {
      ASSERT_LT(object->history[i - 1].stamp, object->history[i].stamp);
    }
    EXPECT_LE(object->t_k(), scene.stamp);
    EXPECT_LE(object->first_seen, object->last_seen);
    EXPECT_LE(object->last_seen, scene.stamp);
    EXPECT_LE(object->tracked_since, object->t_k());
    EXPECT_GE(object->bound.at_m, 0);
    for (const StampedPose& pose : object->history) {
      EXPECT_TRUE(pose.T_W_O.translation.allFinite());
    }
  }
  for (const DynamicVoxel& voxel : scene.dynamic_W.voxels()) {
    EXPECT_LE(voxel.first_hit, voxel.last_hit);
    EXPECT_LE(voxel.last_hit, scene.stamp);
  }
}

// Two sources of random frames, of which each frame of the second may be late.
std::vector<Frame> Interleaved(unsigned seed, int count) {
  RandomFrames front(seed), rear(seed + 1000);
  testing_support::Random random(seed);
  std::vector<Frame> frames;
  Duration behind{};
  for (int i = 0; i < count; ++i) {
    frames.push_back(Of("front", front.Next()));
    Frame late = Of("rear", rear.Next());
    behind = FromSeconds(random.Uniform(0, 0.2));
    const Time stamp = frames.back().stamp - behind;
    for (ObjectMotion& motion : late.motions) motion.from = stamp - FromSeconds(0.1);
    late.stamp = stamp;
    const bool goes_back = i > 0 && stamp < frames[frames.size() - 2].stamp;
    if (!goes_back) frames.push_back(std::move(late));
  }
  return frames;
}

class LateRandom : public testing::TestWithParam<int> {};

// Each option by itself, and all of them.
SceneParams ParamsOf(int option) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = 0.2;
  const auto on = [&](int which) { return option == which || option == 8; };
  if (on(1)) params.filter_labels = true;
  if (on(2)) params.dynamic_life = std::chrono::milliseconds(500);
  if (on(3)) params.reidentify = true;
  if (on(4)) params.sensor_pose_error_m = 0.05;
  if (on(5)) params.object_pose_error_m = 0.05;
  if (on(6)) params.solid = SolidMode::kCompletedHull;
  if (on(7)) params.clear_objects_by_rays = true;
  if (on(8)) {
    params.motion = MotionModel::kTrack;
    params.rest_distance_m = 0.1;
    params.keep_distance_m = 20;
  }
  return params;
}

TEST_P(LateRandom, KeepsTheSceneInOrderWhateverTheThreads) {
  ThreadPool one(1), two(2);
  SceneBuilder dut(ParamsOf(GetParam()), {}, two), other(ParamsOf(GetParam()), {}, one);
  ScenePtr before = dut.Publish();
  std::size_t late = 0;
  for (const Frame& frame : Interleaved(1 + GetParam(), 15)) {
    const auto report = dut.Apply(frame);
    const auto again = other.Apply(frame);
    ASSERT_EQ(report.status(), again.status());
    if (!report.ok()) continue;  // parts of parts
    late += report->late_by > Duration::zero();
    const ScenePtr scene = dut.Publish();
    ASSERT_EQ(scene->Hash(), other.Publish()->Hash());
    ExpectOrdered(*scene);
    EXPECT_GE(scene->stamp, before->stamp);
    before = scene;
  }
  EXPECT_GT(late, 5u);
}

INSTANTIATE_TEST_SUITE_P(Options, LateRandom, testing::Range(0, 9));

}  // namespace
}  // namespace clearway
