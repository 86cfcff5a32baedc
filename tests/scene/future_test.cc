// Stated futures, and what frames make of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing::StartsWith;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::FirstOrigin;
using testing_support::FrameAt;

// Object 5 at (4, 0, 0) at 1 s, its last motion 1 m/s along x.
class FutureTest : public testing::Test {
 protected:
  FutureTest() {
    Frame frame = FrameAt(1);
    AddPoint(frame, 5, {4, 0, 0});
    frame.motions = {{5, Pose::Translation(1, 0, 0), At(0)}};
    EXPECT_TRUE(dut_.Apply(frame).ok());
  }
  // From where O is at first.
  static Eigen::Vector3d Along(double x_m, double y_m, double z_m) {
    return FirstOrigin({4, 0, 0}) + Eigen::Vector3d(x_m, y_m, z_m);
  }
  static Pose PoseAlong(double x_m, double y_m, double z_m) {
    Pose T_W_O;
    T_W_O.translation = Along(x_m, y_m, z_m);
    return T_W_O;
  }
  // 2 m/s along y.
  static std::vector<StampedPose> Sideways() {
    return {{At(2), PoseAlong(0, 2, 0)}, {At(3), PoseAlong(0, 4, 0)}};
  }
  const MovingObject& Object() {
    scene_ = dut_.Publish();
    return *scene_->FindObject(5);
  }
  Eigen::Vector3d Where(double seconds) {
    const MovingObject& object = Object();
    return PredictPose(object, At(seconds), scene_->params.horizon).T_W_O.translation;
  }
  void Move(double seconds, double from_s, const Eigen::Vector3d& way_W) {
    Frame frame = FrameAt(seconds);
    frame.motions = {{5, Pose::Translation(way_W.x(), way_W.y(), way_W.z()), At(from_s)}};
    ASSERT_TRUE(dut_.Apply(frame).ok());
  }
  void ExpectRefused(ObjectId id, const std::vector<StampedPose>& poses, absl::StatusCode code,
                     const std::string& message) {
    const ScenePtr before = dut_.Publish();
    const absl::Status status = dut_.SetFuture(id, poses);
    EXPECT_EQ(status.code(), code) << status;
    EXPECT_THAT(std::string(status.message()), StartsWith(message));
    EXPECT_EQ(dut_.Publish(), before);
  }

  ThreadPool pool_{1};
  SceneBuilder dut_{{}, {}, pool_};
  ScenePtr scene_;
};

TEST_F(FutureTest, CountsInsteadOfTheLastMotionUntilItIsWithdrawn) {
  EXPECT_LT((Where(2) - Along(1, 0, 0)).norm(), 1e-6);
  ASSERT_TRUE(dut_.SetFuture(5, Sideways()).ok());
  EXPECT_LT((Where(2.5) - Along(0, 3, 0)).norm(), 1e-6);
  EXPECT_LT((Where(4) - Along(0, 6, 0)).norm(), 1e-6);
  ASSERT_TRUE(dut_.SetFuture(5, {}).ok());
  EXPECT_LT((Where(2) - Along(1, 0, 0)).norm(), 1e-6);
}

TEST_F(FutureTest, FramesForgetWhatHasComeAndThenTheLastMotionHolds) {
  ASSERT_TRUE(dut_.SetFuture(5, Sideways()).ok());
  Move(2, 1, {0, 1.5, 0});
  EXPECT_EQ(Object().future.size(), 1u) << "a pose of t_k itself has come";
  EXPECT_LT((Where(2.5) - Along(0, 2.75, 0)).norm(), 1e-6) << "from where it is";
  Move(3.5, 2, {0, 0, 3});
  EXPECT_TRUE(Object().future.empty());
  EXPECT_LT((Where(4.5) - Along(0, 1.5, 5)).norm(), 1e-6);
}

// Whatever frames find shortly before the end.
TEST_F(FutureTest, GoesOnAsItWasStated) {
  ASSERT_TRUE(dut_.SetFuture(5, Sideways()).ok());
  Move(2.999, 1, {0.1, 3.9, 0});
  EXPECT_EQ(Object().future.size(), 1u);
  EXPECT_LT((Where(4) - Along(0, 6, 0)).norm(), 1e-6);
  std::vector<StampedPose> parks = Sideways();
  for (StampedPose& pose : parks) pose.stamp += FromSeconds(2);
  parks.push_back({At(6), parks.back().T_W_O});
  ASSERT_TRUE(dut_.SetFuture(5, parks).ok());
  Move(5.5, 2.999, {0, 0.05, 0});
  EXPECT_LT((Where(900) - Along(0, 4, 0)).norm(), 1e-6);
}

TEST_F(FutureTest, BridgesAFrameWithoutAMotion) {
  ASSERT_TRUE(dut_.SetFuture(5, Sideways()).ok());
  Frame frame = FrameAt(2.5);
  AddPoint(frame, 5, {4, 3, 0});
  ASSERT_TRUE(dut_.Apply(frame).ok());
  EXPECT_TRUE(Object().bridged);
  EXPECT_LT((Where(2.5) - Along(0, 3, 0)).norm(), 1e-6);
  frame = FrameAt(4);
  AddPoint(frame, 5, {4, 6, 0});
  ASSERT_TRUE(dut_.Apply(frame).ok());
  EXPECT_TRUE(Object().future.empty());
  EXPECT_LT((Where(5) - Along(0, 8, 0)).norm(), 1e-6) << "as its future ended";
}

// The horizon counts from the future's end, and within it an object seen again is the same one.
TEST_F(FutureTest, PlacesItBeyondTheHorizonOfItsLastMotion) {
  ASSERT_TRUE(dut_.SetFuture(5, {{At(8), PoseAlong(0, 7, 0)}}).ok());
  Frame frame = FrameAt(9);
  AddPoint(frame, 5, {4, 8, 0});
  const auto report = dut_.Apply(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->objects_created, 0u);
  EXPECT_LT((Where(9) - Along(0, 8, 0)).norm(), 1e-6);
}

TEST_F(FutureTest, BadInputIsNamed) {
  constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
  ExpectRefused(6, Sideways(), absl::StatusCode::kNotFound, "object_id: the scene has no object 6");
  std::vector<StampedPose> poses = Sideways();
  poses[0].stamp = At(1);
  ExpectRefused(5, poses, kInvalid, "future.stamps_ns[0]: is 1000000000, not after the object's");
  poses = Sideways();
  poses[1].stamp = poses[0].stamp;
  ExpectRefused(5, poses, kInvalid, "future.stamps_ns[1]: is 2000000000, not after the one before");
  poses = Sideways();
  poses[1].stamp = Time::max();
  ExpectRefused(5, poses, kInvalid, "future.stamps_ns[1]: is 9223372036854775807");
  poses = Sideways();
  poses[1].T_W_O.translation.z() = std::nan("");
  ExpectRefused(5, poses, kInvalid, "future.world_from_object[1]: is not finite");
  poses[1].T_W_O.translation.z() = 1e7;
  ExpectRefused(5, poses, kInvalid, "future.world_from_object[1].translation_m: reaches 1e+07");
  poses.resize(kMaxFuturePoses + 1);
  ExpectRefused(5, poses, absl::StatusCode::kResourceExhausted, "future: 10001 poses");
}

TEST_F(FutureTest, OfManyAllOrNoneAreTaken) {
  const std::vector<ObjectFuture> futures{{5, Sideways()}, {6, Sideways()}};
  const absl::Status status = dut_.SetFutures(futures);
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), StartsWith("futures[1].object_id: the scene has no"));
  EXPECT_TRUE(Object().future.empty());
  ASSERT_TRUE(dut_.SetFutures(std::span(futures).first(1)).ok());
  EXPECT_EQ(Object().future, Sideways());
}

}  // namespace
}  // namespace clearway
