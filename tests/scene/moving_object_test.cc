#include "clearway/scene/moving_object.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;
using testing_support::Random;

MovingObject ObjectWith(std::vector<StampedPose> history, std::optional<Twist> velocity_O) {
  MovingObject object;
  object.id = 1;
  VoxelMap map_O(0.5);
  for (int x = -2; x < 2; ++x) map_O.Set({x, 0, 0}, 100);
  object.history = std::move(history);
  object.velocity_O = velocity_O;
  return WithMap(std::move(object), map_O);
}

constexpr Duration kHorizon = std::chrono::seconds(2);

void ExpectNear(const Pose& a, const Pose& b) {
  EXPECT_LT((a.translation - b.translation).norm(), 1e-9);
  EXPECT_GT(std::abs(a.rotation.dot(b.rotation)), 1 - 1e-12);
}

TEST(MovingObject, EmptyMapHasAnEmptySolid) {
  const auto dut = SolidOf(VoxelMap(0.1));
  EXPECT_TRUE(dut->hull->triangles.empty());
  EXPECT_TRUE(dut->box_O.Empty());
  EXPECT_EQ(dut->radius_m, 0);
}

TEST(MovingObject, SolidHoldsEveryOccupiedVoxelAndNoFreeOne) {
  Random random(1);
  VoxelMap map_O(0.2);
  for (int i = 0; i < 300; ++i) {
    map_O.Set({random.Integer(-5, 5), random.Integer(-9, 3), random.Integer(0, 4)}, 10);
  }
  map_O.Set({40, 0, 0}, -10);
  const auto dut = SolidOf(map_O);
  map_O.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int i) {
      const Aabb voxel = map_O.grid().BoxOf(VoxelAt(key, i));
      EXPECT_TRUE(NearHull(*dut->hull, voxel.min, 1e-9));
      EXPECT_TRUE(NearHull(*dut->hull, voxel.max, 1e-9));
    });
  });
  EXPECT_LT((dut->box_O.max - map_O.OccupiedBox().max).norm(), 1e-12);
  EXPECT_LT((dut->box_O.min - map_O.OccupiedBox().min).norm(), 1e-12);
}

TEST(MovingObject, AtRestStaysForEver) {
  const Pose T_W_O = Pose::Translation(1, 2, 3);
  for (const auto& velocity : {std::optional<Twist>(), std::optional<Twist>(Twist{})}) {
    const MovingObject dut = ObjectWith({{At(1), T_W_O}}, velocity);
    EXPECT_EQ(PredictPose(dut, At(1000), kHorizon).T_W_O, T_W_O);
    EXPECT_FALSE(PredictPose(dut, At(1000), kHorizon).beyond_horizon_radius_m);
  }
}

TEST(MovingObject, PredictsAConstantScrew) {
  Random random(2);
  const Pose T_W_O = random.AnyPose(100);
  const Twist velocity{0.5 * random.UnitVector(), random.Vector(3)};
  const MovingObject dut = ObjectWith({{At(10), T_W_O}}, velocity);
  ExpectNear(PredictPose(dut, At(10), kHorizon).T_W_O, T_W_O);
  ExpectNear(PredictPose(dut, At(11.5), kHorizon).T_W_O, T_W_O * Exp(1.5 * velocity));
}

// The paper writes the prediction as a power of the world-frame motion.
TEST(MovingObject, PredictionIsThePowerOfTheWorldMotion) {
  Random random(3);
  const Pose T0 = random.AnyPose(50),
             T1 = T0 * Exp({0.1 * random.UnitVector(), random.Vector(0.3)});
  const Pose H_W = T1 * Inverse(T0);
  const MovingObject dut = ObjectWith({{At(0), T0}, {At(0.1), T1}}, 10.0 * Log(Inverse(T0) * T1));
  Pose power = T1;
  for (int steps = 1; steps <= 10; ++steps) {
    power = H_W * power;
    ExpectNear(PredictPose(dut, At(0.1 + 0.1 * steps), kHorizon).T_W_O, power);
  }
}

TEST(MovingObject, BeyondTheHorizonGrowsWithItsSpeed) {
  const MovingObject dut = ObjectWith({{At(0), Pose()}}, Twist{{0, 0, 1}, {3, 0, 0}});
  EXPECT_FALSE(PredictPose(dut, At(2), kHorizon).beyond_horizon_radius_m);
  const PredictedPose beyond = PredictPose(dut, At(3.5), kHorizon);
  ASSERT_TRUE(beyond.beyond_horizon_radius_m);
  EXPECT_NEAR(*beyond.beyond_horizon_radius_m, dut.solid->radius_m + 1.5 * 3, 1e-9);
  ExpectNear(beyond.T_W_O, PredictPose(dut, At(2), kHorizon).T_W_O);
}

MovingObject ObjectBoundFor(std::vector<StampedPose> future) {
  return WithFuture(ObjectWith({{At(0), Pose()}, {At(1), Pose::Translation(1, 0, 0)}},
                               Twist{Eigen::Vector3d::Zero(), {1, 0, 0}}),
                    std::move(future));
}

TEST(MovingObject, InterpolatesAStatedFuture) {
  Random random(5);
  const Pose b = random.AnyPose(5), c = random.AnyPose(5);
  const MovingObject dut = ObjectBoundFor({{At(2), b}, {At(5), c}});
  const Pose& a = dut.history.back().T_W_O;
  ExpectNear(PredictPose(dut, At(0.5), kHorizon).T_W_O, Pose::Translation(0.5, 0, 0));
  ExpectNear(PredictPose(dut, At(1), kHorizon).T_W_O, a);
  ExpectNear(PredictPose(dut, At(1.25), kHorizon).T_W_O, Interpolate(a, b, 0.25));
  ExpectNear(PredictPose(dut, At(2), kHorizon).T_W_O, b);
  ExpectNear(PredictPose(dut, At(4), kHorizon).T_W_O, Interpolate(b, c, 2. / 3));
  ExpectNear(PredictPose(dut, At(5), kHorizon).T_W_O, c);
  EXPECT_FALSE(PredictPose(dut, At(5), kHorizon).beyond_horizon_radius_m);
}

TEST(MovingObject, GoesOnAsItsFutureEndedAndTheHorizonCountsFromThere) {
  const MovingObject dut =
      ObjectBoundFor({{At(2), Pose::Translation(1, 1, 0)}, {At(4), Pose::Translation(1, 5, 0)}});
  ExpectNear(PredictPose(dut, At(5), kHorizon).T_W_O, Pose::Translation(1, 7, 0));
  EXPECT_FALSE(PredictPose(dut, At(6), kHorizon).beyond_horizon_radius_m);
  const PredictedPose beyond = PredictPose(dut, At(7), kHorizon);
  ASSERT_TRUE(beyond.beyond_horizon_radius_m);
  EXPECT_NEAR(*beyond.beyond_horizon_radius_m, dut.solid->radius_m + 2, 1e-9);
  ExpectNear(beyond.T_W_O, Pose::Translation(1, 9, 0));
  EXPECT_NEAR(dut.SpeedMps(), 1, 1e-9) << "to the first pose";
  EXPECT_FALSE(dut.AtRest());
}

TEST(MovingObject, StaysForEverWhereItsFutureRests) {
  const Pose there = Pose::Translation(3, 0, 0);
  const MovingObject dut = ObjectBoundFor({{At(2), there}, {At(3), there}});
  EXPECT_EQ(PredictPose(dut, At(1000), kHorizon).T_W_O, there);
  EXPECT_FALSE(PredictPose(dut, At(1000), kHorizon).beyond_horizon_radius_m);
}

TEST(MovingObject, OneFuturePoseGivesTheVelocityFromTheNewestPose) {
  const MovingObject dut = ObjectBoundFor({{At(2), Pose::Translation(1, 3, 0)}});
  ExpectNear(PredictPose(dut, At(3), kHorizon).T_W_O, Pose::Translation(1, 6, 0));
}

TEST(MovingObject, InterpolatesThePastAndHoldsItsFirstPose) {
  Random random(4);
  const Pose a = random.AnyPose(5), b = random.AnyPose(5), c = random.AnyPose(5);
  const MovingObject dut =
      ObjectWith({{At(1), a}, {At(2), b}, {At(4), c}}, Twist{Eigen::Vector3d::Zero(), {1, 0, 0}});
  ExpectNear(PredictPose(dut, At(0), kHorizon).T_W_O, a);
  ExpectNear(PredictPose(dut, At(2), kHorizon).T_W_O, b);
  ExpectNear(PredictPose(dut, At(3), kHorizon).T_W_O, Interpolate(b, c, 0.5));
}

}  // namespace
}  // namespace clearway
