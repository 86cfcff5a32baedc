// Where an object's frame goes, and what its map gathers (II-D).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <set>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FirstOrigin;
using testing_support::FrameAt;
using testing_support::Random;

class ObjectMotionTest : public testing::Test {
 protected:
  SceneBuilder Builder(const SceneParams& params = {}) { return SceneBuilder(params, {}, pool_); }
  const MovingObject& ObjectAfter(SceneBuilder& dut, const Frame& frame, ObjectId id = 5) {
    EXPECT_TRUE(dut.Apply(frame).ok());
    scene_ = dut.Publish();
    const MovingObject* object = scene_->FindObject(id);
    EXPECT_NE(object, nullptr);
    return *object;
  }
  ThreadPool pool_{1};
  ScenePtr scene_;
};

Frame Seen(double seconds, const Pose& T_W_B, ObjectId id = 5) {
  Frame frame = FrameAt(seconds);
  AddObject(frame, id, T_W_B, BoxSurface({1, 0.6, 0.4}, 0.05));
  return frame;
}

TEST_F(ObjectMotionTest, FirstSightIsNearTheCentroidWithoutTurn) {
  SceneBuilder dut = Builder();
  const MovingObject& object = ObjectAfter(dut, Seen(1, Pose::Translation(4, 1, 0)));
  EXPECT_LT((object.history.back().T_W_O.translation - Eigen::Vector3d(4, 1, 0)).norm(), 0.1);
  EXPECT_EQ(object.history.back().T_W_O.rotation.w(), 1);
  EXPECT_TRUE(object.AtRest());
  EXPECT_EQ(object.frames_seen, 1);
}

// Which of its voxels a surface runs through must not hang on the labels of a few points.
TEST_F(ObjectMotionTest, WrongLabelsAtFirstSightDoNotMoveItsVoxels) {
  const auto surface = [](const MovingObject& object) {
    std::set<std::array<std::int64_t, 3>> centers_tenth_mm;
    const VoxelGrid& grid = object.map_O.grid();
    object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
      block.occupied.ForEach([&](int index) {
        const Eigen::Vector3d center_W =
            object.history.back().T_W_O * grid.CenterOf(VoxelAt(block_key, index));
        const auto rounded = (1e4 * center_W).array().round().cast<std::int64_t>().eval();
        centers_tenth_mm.insert({rounded.x(), rounded.y(), rounded.z()});
      });
    });
    return centers_tenth_mm;
  };
  Frame clean = Seen(1, Pose::Translation(4.03, 1.01, 0)), wrong = clean;
  std::fill_n(wrong.labels.begin(), 20, kStaticLabel);
  AddPoint(wrong, 5, {9, 3, 1});
  SceneBuilder of_clean = Builder(), of_wrong = Builder();
  const auto right = surface(ObjectAfter(of_clean, clean));
  std::size_t alike = 0;
  for (const auto& center : surface(ObjectAfter(of_wrong, wrong))) alike += right.contains(center);
  EXPECT_GT(alike, 0.9 * static_cast<double>(right.size()));
}

// Nor, where it lies between voxels, on rounding.
TEST_F(ObjectMotionTest, ASurfaceOfRoundMeasuresIsOneVoxelThick) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(1);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const double noise_m = i % 2 == 0 ? 1e-6 : -1e-6;
    AddPoint(frame, 5, {4 + noise_m, random.Uniform(-1, 1), random.Uniform(-1, 1)});
  }
  const MovingObject& object = ObjectAfter(dut, frame);
  EXPECT_NEAR(object.observed_box_O.Size().x(), 0.1, 1e-9);
}

TEST_F(ObjectMotionTest, FollowsWorldMotions) {
  SceneBuilder dut = Builder();
  Random random(1);
  Pose T_W_B = Pose::Translation(4, 1, 0);
  Pose T_W_O = ObjectAfter(dut, Seen(0, T_W_B)).history.back().T_W_O;
  for (int k = 1; k <= 20; ++k) {
    const Pose next = T_W_B * Exp({0.05 * random.UnitVector(), random.Vector(0.2)});
    const Pose H_W = next * Inverse(T_W_B);
    Frame frame = Seen(0.1 * k, next);
    frame.motions.push_back({5, H_W, At(0.1 * (k - 1))});
    T_W_O = H_W * T_W_O;
    const MovingObject& object = ObjectAfter(dut, frame);
    EXPECT_LT((object.history.back().T_W_O.translation - T_W_O.translation).norm(), 1e-9);
    EXPECT_FALSE(object.bridged);
    T_W_B = next;
  }
}

TEST_F(ObjectMotionTest, PosesCarryTheFrameOverGaps) {
  SceneBuilder dut = Builder();
  Random random(2);
  const Pose T_W_B0 = random.AnyPose(3), T_W_B1 = random.AnyPose(3);
  Frame first = Seen(0, T_W_B0), second = Seen(4, T_W_B1);
  first.poses.push_back({5, T_W_B0});
  second.poses.push_back({5, T_W_B1});
  const Pose T_W_O0 = ObjectAfter(dut, first).history.back().T_W_O;
  const Pose T_W_O1 = ObjectAfter(dut, second).history.back().T_W_O;
  const Pose T_B_O0 = Inverse(T_W_B0) * T_W_O0, T_B_O1 = Inverse(T_W_B1) * T_W_O1;
  EXPECT_LT((T_B_O0.translation - T_B_O1.translation).norm(), 1e-9);
  EXPECT_GT(std::abs(T_B_O0.rotation.dot(T_B_O1.rotation)), 1 - 1e-12);
}

TEST_F(ObjectMotionTest, ALabelWithoutAMotionIsBridgedByPrediction) {
  SceneBuilder dut = Builder();
  ObjectAfter(dut, Seen(0, Pose::Translation(4, 0, 0)));
  Frame moved = Seen(0.1, Pose::Translation(4.2, 0, 0));
  moved.motions.push_back({5, Pose::Translation(0.2, 0, 0), At(0)});
  ObjectAfter(dut, moved);
  const MovingObject& object = ObjectAfter(dut, Seen(0.3, Pose::Translation(4.6, 0, 0)));
  EXPECT_TRUE(object.bridged);
  EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({4.6, 0, 0}).x(), 1e-5);
  EXPECT_NEAR(object.SpeedMps(), 2.0, 1e-9);
}

TEST_F(ObjectMotionTest, AMotionWithoutPointsMovesTheObject) {
  SceneBuilder dut = Builder();
  ObjectAfter(dut, Seen(0, Pose::Translation(4, 0, 0)));
  Frame unseen = FrameAt(0.1);
  unseen.motions.push_back({5, Pose::Translation(0.3, 0, 0), At(0)});
  const MovingObject& object = ObjectAfter(dut, unseen);
  EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({4.3, 0, 0}).x(), 1e-5);
  EXPECT_EQ(object.last_seen, At(0));
  EXPECT_EQ(object.frames_seen, 1);
}

TEST_F(ObjectMotionTest, AMotionOfAnUnknownObjectIsIgnoredAndCounted) {
  SceneBuilder dut = Builder();
  Frame frame = FrameAt(0.1);
  frame.motions.push_back({5, Pose::Translation(0.3, 0, 0), At(0)});
  frame.poses.push_back({6, Pose()});
  const auto report = dut.Apply(frame);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->motions_ignored, 2u);
  EXPECT_TRUE(dut.Publish()->objects.empty());
}

TEST_F(ObjectMotionTest, AMotionAtFirstSightGivesTheVelocity) {
  SceneBuilder dut = Builder();
  Frame frame = Seen(0.1, Pose::Translation(4, 0, 0));
  frame.motions.push_back({5, Pose::Translation(0.3, 0, 0), At(0)});
  EXPECT_NEAR(ObjectAfter(dut, frame).SpeedMps(), 3.0, 1e-9);
}

// What the object's motions are after 1.5 s at 10 Hz of `T_W_B` by the number of the frame.
class ObjectRestTest : public ObjectMotionTest {
 protected:
  const MovingObject& ObjectAlong(const std::function<Pose(int)>& T_W_B, double rest_distance_m) {
    SceneParams params;
    params.rest_distance_m = rest_distance_m;
    SceneBuilder dut = Builder(params);
    ObjectAfter(dut, Seen(0, T_W_B(0)));
    for (int k = 1; k < 15; ++k) {
      Frame frame = Seen(0.1 * k, T_W_B(k));
      frame.motions.push_back({5, T_W_B(k) * Inverse(T_W_B(k - 1)), At(0.1 * (k - 1))});
      const MovingObject& object = ObjectAfter(dut, frame);
      if (k < 10) {
        EXPECT_FALSE(object.AtRest()) << "too early to tell";
      }
    }
    return *scene_->FindObject(5);
  }
  static Pose Jitter(int k) { return Pose::Translation(4 + (k % 2 ? 0.1 : 0), 0, 0); }
};

TEST_F(ObjectRestTest, NoiseIsNoMotionButMovesTheFrame) {
  const MovingObject& object = ObjectAlong(Jitter, 0.2);
  EXPECT_TRUE(object.AtRest());
  EXPECT_EQ(object.velocity_O, Twist{});
  EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({4, 0, 0}).x(), 1e-5);
}

TEST_F(ObjectRestTest, WithoutADistanceNoiseIsExtrapolated) {
  EXPECT_NEAR(ObjectAlong(Jitter, 0).SpeedMps(), 1, 1e-9);
}

TEST_F(ObjectRestTest, NoiseBeyondTheDistanceIsMotion) {
  EXPECT_FALSE(ObjectAlong(Jitter, 0.09).AtRest());
}

TEST_F(ObjectRestTest, GoingAndTurningAreNoRest) {
  const auto walk = [](int k) { return Pose::Translation(4 + 0.1 * k, 0, 0); };
  EXPECT_NEAR(ObjectAlong(walk, 0.5).SpeedMps(), 1, 1e-9);
  const auto turn = [](int k) {
    return Pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * k, Eigen::Vector3d::UnitZ())),
                {4, 0, 0}};
  };
  EXPECT_FALSE(ObjectAlong(turn, 0.3).AtRest());
}

TEST_F(ObjectMotionTest, AMotionMayStartBeforeTheLastPose) {
  SceneBuilder dut = Builder();
  ObjectAfter(dut, Seen(0, Pose::Translation(4, 0, 0)));
  Frame second = Seen(0.1, Pose::Translation(4.1, 0, 0));
  second.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0)});
  ObjectAfter(dut, second);
  Frame third = Seen(0.2, Pose::Translation(4.5, 0, 0));
  third.motions.push_back({5, Pose::Translation(0.5, 0, 0), At(0)});
  EXPECT_NEAR(ObjectAfter(dut, third).history.back().T_W_O.translation.x(),
              FirstOrigin({4.5, 0, 0}).x(), 1e-5);
}

TEST_F(ObjectMotionTest, OutOfReachOfPredictionTheModelBeginsAnew) {
  SceneParams params;
  params.horizon = std::chrono::seconds(1);
  SceneBuilder dut = Builder(params);
  ObjectAfter(dut, Seen(0, Pose::Translation(4, 0, 0)));
  Frame moved = Seen(0.1, Pose::Translation(4.2, 0, 0));
  moved.motions.push_back({5, Pose::Translation(0.2, 0, 0), At(0)});
  ObjectAfter(dut, moved);
  const MovingObject& object = ObjectAfter(dut, Seen(3, Pose::Translation(9, 0, 0)));
  EXPECT_EQ(object.first_seen, At(3));
  EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({9, 0, 0}).x(), 1e-5);
}

// Poses are rounded at every step, and motions about a far origin even more.
TEST_F(ObjectMotionTest, StandingStillIsRestWhateverTheRounding) {
  Random random(2);
  for (int run = 0; run < 100; ++run) {
    SceneBuilder dut = Builder();
    Pose T_W_B{random.AnyPose(1).rotation, random.Vector(run % 2 == 0 ? 10 : 50'000)};
    const Pose step = Exp({0.1 * random.UnitVector(), 0.1 * random.UnitVector()});
    const auto seen_from_near = [](double seconds, const Pose& T_W_seen) {
      Frame frame = FrameAt(seconds);
      frame.T_W_S.translation = T_W_seen.translation + Eigen::Vector3d(2, 0, 0);
      AddObject(frame, 5, T_W_seen, {{0, 0, 0}, {0.3, 0, 0}});
      return frame;
    };
    ObjectAfter(dut, seen_from_near(0, T_W_B));
    for (int k = 1; k <= 8; ++k) {
      const Pose next = k <= 5
                            ? T_W_B * step
                            : T_W_B * Exp({1e-14 * random.UnitVector(), Eigen::Vector3d::Zero()});
      Frame frame = seen_from_near(0.1 * k, next);
      frame.motions = {{5, next * Inverse(T_W_B), At(0.1 * (k - 1))}};
      EXPECT_EQ(ObjectAfter(dut, frame).AtRest(), k > 5) << "run " << run << ", frame " << k;
      T_W_B = next;
    }
  }
}

// A motion tells where O is only from a pose that is known.
TEST_F(ObjectMotionTest, AMotionFromOutOfReachBeginsAnewOrIsIgnored) {
  SceneParams params;
  params.horizon = std::chrono::seconds(1);
  SceneBuilder dut = Builder(params);
  ObjectAfter(dut, Seen(0, Pose::Translation(4, 0, 0)));
  const auto moved = [](double seconds, double x_m) {
    Frame frame = Seen(seconds, Pose::Translation(x_m, 0, 0));
    frame.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(seconds - 0.1)});
    return frame;
  };
  ObjectAfter(dut, moved(0.1, 4.1));
  Frame unseen = FrameAt(3);
  unseen.motions = moved(3, 0).motions;
  const auto report = dut.Apply(unseen);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->motions_ignored, 1u);
  EXPECT_EQ(dut.Publish()->FindObject(5)->t_k(), At(0.1));
  const MovingObject& object = ObjectAfter(dut, moved(4, 9));
  EXPECT_EQ(object.first_seen, At(4));
  EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({9, 0, 0}).x(), 1e-5);
  EXPECT_LT(object.solid->box_O.Size().x(), 1.3);
}

TEST_F(ObjectMotionTest, APoseOutOfReachBeginsAnewUnlessItsBoxIsKnown) {
  SceneParams params;
  params.horizon = std::chrono::seconds(1);
  for (bool box_is_known : {false, true}) {
    SceneBuilder dut = Builder(params);
    Frame first = Seen(0, Pose::Translation(4, 0, 0));
    Frame moved = Seen(0.1, Pose::Translation(4.1, 0, 0));
    if (box_is_known) {
      first.poses = {{5, Pose::Translation(4, 0, 0)}};
      moved.poses = {{5, Pose::Translation(4.1, 0, 0)}};
    } else {
      moved.motions = {{5, Pose::Translation(0.1, 0, 0), At(0)}};
    }
    ObjectAfter(dut, first);
    ObjectAfter(dut, moved);
    Frame back = Seen(4, Pose::Translation(9, 0, 0));
    back.poses = {{5, Pose::Translation(9, 0, 0)}};
    const MovingObject& object = ObjectAfter(dut, back);
    EXPECT_EQ(object.first_seen, box_is_known ? At(0) : At(4));
    EXPECT_NEAR(object.history.back().T_W_O.translation.x(), FirstOrigin({9, 0, 0}).x(), 1e-5);
  }
}

// A detector's box may flip from one frame to the next.
TEST_F(ObjectMotionTest, OfHalfATurnBetweenPosesTheTranslationCounts) {
  const Pose flipped{Eigen::Quaterniond(0, 0, 0, 1), {4.1, 0, 0}};
  const Twist dut = VelocityBetween({At(0), Pose::Translation(4, 0, 0)}, {At(0.1), flipped});
  EXPECT_NEAR(dut.linear.norm(), 1, 1e-9);
  EXPECT_EQ(dut.angular.norm(), 0);
}

TEST_F(ObjectMotionTest, HistoryIsBounded) {
  SceneParams params;
  params.history = std::chrono::seconds(1);
  SceneBuilder dut = Builder(params);
  for (int k = 0; k < 50; ++k) {
    Frame frame = Seen(0.1 * k, Pose());
    frame.poses.push_back({5, Pose::Translation(0.1 * k, 0, 0)});
    EXPECT_LE(ObjectAfter(dut, frame).history.size(), 11u);
  }
}

// The model does not depend on whether the object or the sensor moves.
TEST_F(ObjectMotionTest, TheMapIsTheSameWhetherObjectOrSensorMoves) {
  const auto surface = BoxSurface({1, 0.6, 0.4}, 0.03);
  SceneBuilder moving_object = Builder(), moving_sensor = Builder();
  for (int k = 0; k < 10; ++k) {
    const Pose T_W_B = Pose::Translation(4 + 0.1 * k, 0, 0);
    Frame a = FrameAt(0.1 * k), b = FrameAt(0.1 * k);
    b.T_W_S = Pose::Translation(-0.1 * k, 0, 0);
    AddObject(a, 5, T_W_B, surface);
    AddObject(b, 5, Pose::Translation(4, 0, 0), surface);
    if (k > 0) a.motions.push_back({5, Pose::Translation(0.1, 0, 0), At(0.1 * (k - 1))});
    ObjectAfter(moving_object, a);
    ObjectAfter(moving_sensor, b);
  }
  const VoxelMap map_a = moving_object.Publish()->FindObject(5)->map_O;
  const VoxelMap map_b = moving_sensor.Publish()->FindObject(5)->map_O;
  const Aabb box_a = map_a.OccupiedBox(), box_b = map_b.OccupiedBox();
  EXPECT_LE((box_a.min - box_b.min).cwiseAbs().maxCoeff(), 0.1 + 1e-9);
  EXPECT_LE((box_a.max - box_b.max).cwiseAbs().maxCoeff(), 0.1 + 1e-9);
}

}  // namespace
}  // namespace clearway
