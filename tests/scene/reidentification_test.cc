#include "scene/reidentification.h"

#include <gtest/gtest.h>

#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;
using testing_support::Random;

constexpr double kSpeed_mps = 8;
const Eigen::Vector3d kCar(4, 1.8, 1.5), kPerson(0.6, 0.5, 1.7);

Pose Driving(double t) { return Pose::Translation(kSpeed_mps * t, 0, 0); }

// What of a box is seen from the front and from one side, or from behind and the other.
std::vector<Eigen::Vector3d> Half(const Eigen::Vector3d& size_m, double side) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : BoxSurface(size_m, 0.08)) {
    const bool end = p.x() * side >= size_m.x() / 2 - 1e-9;
    const bool flank = p.y() * side >= size_m.y() / 2 - 1e-9;
    if (end || flank) points.push_back(p);
  }
  return points;
}

class Reidentification : public testing::Test {
 protected:
  Reidentification() {
    params_.motion = MotionModel::kTrack;
    params_.rest_distance_m = 0;
  }
  // Seen with poses from one time until another.
  MovingObject Seen(ObjectId id, double from_s, double until_s,
                    const std::vector<Eigen::Vector3d>& points_B, const Pose& T_B_off = {},
                    double direction = 1) {
    SceneBuilder builder(params_, {}, pool_);
    for (double t = from_s; t < until_s - 1e-9; t += 0.1) {
      Frame frame = FrameAt(t);
      const Pose T_W_B = Driving(from_s + direction * (t - from_s)) * T_B_off;
      AddObject(frame, id, T_W_B, points_B);
      frame.poses.push_back({id, T_W_B});
      EXPECT_TRUE(builder.Apply(frame).ok());
    }
    return *builder.Publish()->FindObject(id);
  }

  ThreadPool pool_{1};
  SceneParams params_;
};

TEST_F(Reidentification, TheSameCarIsKnownAgain) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  for (const double side : {-1.0, 1.0}) {
    const MovingObject young = Seen(9, 3.5, 4, Half(kCar, side));
    const auto T_Y_L = SeenAgain(lost, young, params_);
    ASSERT_TRUE(T_Y_L);
    const Pose expected = Inverse(*young.T_B_O) * *lost.T_B_O;
    EXPECT_LT((T_Y_L->translation - expected.translation).norm(), 0.25);
    EXPECT_LT(T_Y_L->rotation.angularDistance(expected.rotation), 0.08);
  }
}

TEST_F(Reidentification, OthersAreNotTakenForIt) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  const auto taken_for_it = [&](const MovingObject& young) {
    return SeenAgain(lost, young, params_).has_value();
  };
  EXPECT_FALSE(taken_for_it(Seen(9, 3.5, 4, BoxSurface({7, 2.4, 3}, 0.08))));
  EXPECT_FALSE(taken_for_it(Seen(9, 3.5, 4, BoxSurface(kPerson, 0.08))));
  EXPECT_FALSE(
      taken_for_it(Seen(9, 3.5, 4, BoxSurface(kPerson, 0.08), Pose::Translation(0, 0.6, 0))));
  // The same car, but elsewhere.
  EXPECT_FALSE(taken_for_it(Seen(9, 3.5, 4, Half(kCar, 1), Pose::Translation(0, 20, 0))));
  // Hardly anything of it.
  EXPECT_FALSE(taken_for_it(Seen(9, 3.5, 3.6, {{2, 0, 0}, {2, 0.3, 0}, {2, 0.6, 0}})));
  // The other way round, in its place.
  EXPECT_FALSE(taken_for_it(Seen(9, 3.5, 4, BoxSurface(kCar, 0.08), {}, -1)));
  // After so long nobody knows.
  EXPECT_FALSE(taken_for_it(Seen(9, 12, 12.5, Half(kCar, 1))));
}

// A car is most of a van, as far as lengths and widths go.
TEST_F(Reidentification, NothingMuchLowerIsTakenForIt) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface({4, 1.8, 2.1}, 0.08));
  EXPECT_TRUE(SeenAgain(lost, Seen(9, 3.5, 4, Half({4, 1.8, 2.1}, 1)), params_));
  EXPECT_FALSE(SeenAgain(lost, Seen(9, 3.5, 4, BoxSurface({4, 1.8, 1.3}, 0.08)), params_));
}

// One like it could be beside it.
TEST_F(Reidentification, NothingIsKnownAgainByPosesThatAreFarOff) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  const MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  params_.object_pose_error_m = 0.5;
  EXPECT_TRUE(SeenAgain(lost, young, params_));
  params_.object_pose_error_m = 1.2;
  EXPECT_FALSE(SeenAgain(lost, young, params_));
}

TEST_F(Reidentification, JoinedLongAfterItWasSeenItHasItsLastPose) {
  params_.history = std::chrono::milliseconds(250);
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  const MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  const Pose T_Y_L = Inverse(*young.T_B_O) * *lost.T_B_O;
  const MovingObject dut = Joined(lost, young, T_Y_L, At(5), params_, pool_);
  ASSERT_FALSE(dut.history.empty());
  EXPECT_EQ(dut.t_k(), young.t_k());
}

// Where the voxels fit is too far from where it was to be, or it is there and they do not.
TEST_F(Reidentification, FittingElsewhereItIsAnother) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  for (const double off_m : {0.0, 1.0, 3.0}) {
    const MovingObject young = Seen(9, 3.5, 4, Half(kCar, 1), Pose::Translation(0, off_m, 0));
    const Pose T_Y_L = Inverse(*young.T_B_O) * *lost.T_B_O;
    EXPECT_EQ(FitsThere(lost, young, T_Y_L, params_), off_m < 2) << off_m;
    EXPECT_FALSE(FitsThere(lost, young, T_Y_L * Pose::Translation(0, 0.4, 0), params_)) << off_m;
  }
}

// Whatever lever arm there is between the two frames, and however fast it turns.
TEST_F(Reidentification, JoinedItMovesAsItDid) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  const Pose T_Y_L(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY())),
                   {0.5, -1.5, 0.2});
  for (const double turn_radps : {0.0, 1.0, 3.5, 5.0}) {
    young.velocity_O = Twist{{0.1, 0, turn_radps}, {8, 1, 0}};
    const MovingObject dut = Joined(lost, young, T_Y_L, young.t_k(), params_, pool_);
    constexpr double kAhead_s = 0.1;
    const Pose expected = Exp(kAhead_s * *young.velocity_O) * T_Y_L;
    const Pose found = T_Y_L * Exp(kAhead_s * *dut.velocity_O);
    EXPECT_LT((found.translation - expected.translation).norm(), 1e-9) << turn_radps;
    EXPECT_LT(found.rotation.angularDistance(expected.rotation), 1e-9) << turn_radps;
  }
}

TEST_F(Reidentification, JoinedItGoesByAllIdsOfBoth) {
  MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  lost.also = {7};
  lost.older_ids_told = {At(1)};
  young.also = {11};
  young.older_ids_told = {At(3.7)};
  const Pose T_Y_L = Inverse(*young.T_B_O) * *lost.T_B_O;
  const MovingObject dut = Joined(lost, young, T_Y_L, young.t_k(), params_, pool_);
  EXPECT_EQ(dut.also, (std::vector<ObjectId>{7, 9, 11}));
  EXPECT_EQ(dut.older_ids_told, (std::vector<Time>{At(1), lost.t_k(), At(3.7)}));
}

TEST_F(Reidentification, JoinedItsPredictedPosesAreNoWitnesses) {
  const MovingObject lost = Seen(5, 0, 2, BoxSurface(kCar, 0.08));
  MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  young.tracked_since = At(3.8);
  const Pose T_Y_L = Inverse(*young.T_B_O) * *lost.T_B_O;
  EXPECT_EQ(Joined(lost, young, T_Y_L, young.t_k(), params_, pool_).tracked_since, At(3.8));
}

TEST_F(Reidentification, JoinedItHasBothViewsAndBothTracks) {
  const MovingObject lost = Seen(5, 0, 2, Half(kCar, -1));
  const MovingObject young = Seen(9, 3.5, 4, BoxSurface(kCar, 0.08));
  const Time stamp = young.t_k();
  const Pose T_Y_L = Inverse(*young.T_B_O) * *lost.T_B_O;
  const MovingObject dut = Joined(lost, young, T_Y_L, stamp, params_, pool_);
  EXPECT_EQ(dut.id, 5);
  EXPECT_EQ(dut.t_k(), stamp);
  EXPECT_EQ(dut.history.size(), lost.history.size() + young.history.size());
  for (const StampedPose& pose : dut.history) {
    const Pose expected = Driving(ToSeconds(pose.stamp - At(0))) * *lost.T_B_O;
    EXPECT_LT((pose.T_W_O.translation - expected.translation).norm(), 1e-6);
  }
  EXPECT_GT(dut.map_O.occupied_count(), 1.5 * lost.map_O.occupied_count());
  ASSERT_TRUE(dut.velocity_O);
  EXPECT_LT((dut.velocity_O->linear - Eigen::Vector3d(kSpeed_mps, 0, 0)).norm(), 1e-6);
  ASSERT_TRUE(dut.T_B_O);
  EXPECT_LT((dut.T_B_O->translation - lost.T_B_O->translation).norm(), 1e-6);
  EXPECT_EQ(dut.tracked_since, young.history.front().stamp);
  EXPECT_EQ(dut.frames_seen, lost.frames_seen + young.frames_seen);
}

TEST_F(Reidentification, MoreMayBeDoubtedTheLongerItIsLookedAt) {
  const auto may_be_doubted = [&](double looked_s) {
    return MayBeDoubted(Seen(9, 0, looked_s + 0.1, BoxSurface(kCar, 0.2)));
  };
  EXPECT_EQ(may_be_doubted(0.3), may_be_doubted(0.6));
  double before = 0;
  for (const double looked_s : {0.6, 1.0, 1.5, 2.0}) {
    const double now = may_be_doubted(looked_s);
    EXPECT_GT(now, before) << looked_s;
    EXPECT_LT(now, 1) << looked_s;
    before = now;
  }
}

}  // namespace
}  // namespace clearway
