#include "clearway/sim/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "support/random.h"

namespace clearway {
namespace {

using testing::ElementsAre;
using testing::Optional;

Time At(double seconds) { return Time(FromSeconds(seconds)); }

// A static wall at x = 5 m; object 4, a box that drives along x at 1 m/s; object 2, a cylinder that
// turns on the spot, on a bar of 4 m.
World TestWorld() {
  World world;
  world.Add(Body::Single(0, "wall", Box{{1, 20, 20}}, FixedPose{Pose::Translation(5, 0, 0)}));
  world.Add(
      Body::Single(4, "box", Box{{2, 1, 1}}, ConstantTwist{Pose(), {{0, 0, 0}, {1, 0, 0}}, At(0)}));
  world.Add({2,
             "pair",
             {{Cylinder{0.5, 1}, Pose::Translation(2, 0, 0)},
              {Cylinder{0.5, 1}, Pose::Translation(-2, 0, 0)}},
             ConstantTwist{Pose::Translation(0, 10, 0), {{0, 0, 1}, {0, 0, 0}}, At(0)}});
  return world;
}

TEST(WorldTest, Empty) {
  const World dut;
  EXPECT_TRUE(dut.ObjectIds().empty());
  EXPECT_EQ(dut.ObjectAt({0, 0, 0}, At(0)), std::nullopt);
  EXPECT_EQ(dut.Touched(Sphere{1}, Pose(), At(0)), std::nullopt);
  EXPECT_EQ(dut.T_W_B(1, At(0)), std::nullopt);
}

TEST(WorldTest, IdsAreAscendingWithoutTheStaticWorld) {
  EXPECT_THAT(TestWorld().ObjectIds(), ElementsAre(2, 4));
}

TEST(WorldTest, PointsAreInWhatIsThereAtTheTime) {
  const World dut = TestWorld();
  EXPECT_THAT(dut.ObjectAt({0.9, 0, 0}, At(0)), Optional(4));
  EXPECT_EQ(dut.ObjectAt({0.9, 0, 0}, At(2)), std::nullopt);
  EXPECT_THAT(dut.ObjectAt({2.9, 0, 0}, At(2)), Optional(4));
  EXPECT_THAT(dut.ObjectAt({4.6, 3, 0}, At(2)), Optional(0));
}

TEST(WorldTest, AnObjectInsideTheStaticWorldCountsBeforeIt) {
  EXPECT_THAT(TestWorld().ObjectAt({4.6, 0, 0}, At(4)), Optional(4));
  EXPECT_THAT(TestWorld().ObjectAt({4.6, 0, 0}, At(40)), Optional(0));
}

TEST(WorldTest, PartsTurnWithTheirBody) {
  const World dut = TestWorld();
  const double quarter_s = std::numbers::pi / 2;
  EXPECT_THAT(dut.ObjectAt({2, 10, 0}, At(0)), Optional(2));
  EXPECT_EQ(dut.ObjectAt({2, 10, 0}, At(quarter_s)), std::nullopt);
  EXPECT_THAT(dut.ObjectAt({0, 12, 0}, At(quarter_s)), Optional(2));
  EXPECT_THAT(dut.ObjectAt({0, 8.4, 0.4}, At(quarter_s)), Optional(2));
}

TEST(WorldTest, MotionLeadsFromOnePoseToTheNext) {
  const World dut = TestWorld();
  for (const ObjectId id : dut.ObjectIds()) {
    const Pose moved = *dut.MotionOf(id, At(0.3), At(1.1)) * *dut.T_W_B(id, At(0.3));
    const Pose expected = *dut.T_W_B(id, At(1.1));
    EXPECT_LT((moved.translation - expected.translation).norm(), 1e-12);
    EXPECT_LT(moved.rotation.angularDistance(expected.rotation), 1e-12);
  }
  EXPECT_EQ(dut.MotionOf(17, At(0), At(1)), std::nullopt);
  EXPECT_EQ(dut.MotionOf(0, At(0), At(1)), std::nullopt);
}

TEST(WorldTest, BoxSpansAllParts) {
  const Aabb box_B = TestWorld().FindObject(2)->BoxB();
  EXPECT_LT((box_B.Size() - Eigen::Vector3d(5, 1, 1)).norm(), 1e-12);
}

TEST(WorldAtTimeTest, AgreesWithEveryBodyInTurn) {
  const World world = TestWorld();
  testing_support::Random random(2);
  for (const double seconds : {0.0, 1.3, 4.2}) {
    const WorldAtTime dut(world, At(seconds));
    for (int i = 0; i < 2'000; ++i) {
      const Eigen::Vector3d p_W = random.Vector(13);
      std::optional<ObjectId> expected;
      for (const Body& body : world.bodies()) {
        for (const BodyPart& part : body.parts) {
          const Pose T_W_G = PoseAt(body.trajectory, At(seconds)) * part.T_B_G;
          if (!Contains(part.shape, Inverse(T_W_G) * p_W)) continue;
          const bool first = !expected || *expected == 0 || (body.id != 0 && body.id < *expected);
          if (first) expected = body.id;
        }
      }
      EXPECT_EQ(dut.ObjectAt(p_W), expected);
    }
  }
}

TEST(WorldAtTimeTest, ShapesTouchWhatIsThereAtTheTime) {
  const World world = TestWorld();
  const Box robot{{1, 1, 1}};
  EXPECT_THAT(WorldAtTime(world, At(0)).Touched(robot, Pose::Translation(1.4, 0, 0)), Optional(4));
  EXPECT_EQ(WorldAtTime(world, At(0)).Touched(robot, Pose::Translation(1.6, 0, 0)), std::nullopt);
  EXPECT_THAT(WorldAtTime(world, At(0.2)).Touched(robot, Pose::Translation(1.6, 0, 0)),
              Optional(4));
  EXPECT_THAT(WorldAtTime(world, At(0)).Touched(robot, Pose::Translation(4.1, 0, 0)), Optional(0));
}

}  // namespace
}  // namespace clearway
