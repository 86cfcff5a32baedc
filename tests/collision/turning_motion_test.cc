// Motions that turn close to surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "clearway/collision/scene_checker.h"
#include "collision/motion_proof.h"
#include "collision/narrowphase.h"
#include "collision/random_motions.h"
#include "collision/test_meshes.h"
#include "collision/test_world.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kGaps_m[] = {1e-6, 1e-5, 1e-4, 5e-4, 1e-3, 3e-3, 5e-3};

Eigen::Quaterniond About(const Eigen::Vector3d& axis, double rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(rad, axis));
}

// Level ground whose voxels end at z = 0.
ScenePtr Floor() {
  static const ScenePtr scene =
      TestWorld().Occupied({{-3, -3, -0.1}, {3, 3, 0}}).Free({{-3, -3, 0}, {3, 3, 3}}).Scene();
  return scene;
}

// How far below its origin a shape reaches in a direction of its own.
double Below(const Shape& shape, const Eigen::Quaterniond& rotation) {
  const ShapeGeometry geometry(shape);
  return -PlacedShape(geometry, {rotation, {0, 0, 0}}).box_F().min.z();
}

std::vector<Shape> ShapesOfAllKinds() {
  RandomWorld random(11);
  std::vector<Shape> shapes{Cylinder{0.3, 1}, Box{{1, 0.7, 1}}, Capsule{0.2, 0.8}};
  for (std::size_t i = 0; i < 2 * std::variant_size_v<Shape>; ++i) {
    shapes.push_back(random.ShapeOfKind(i % std::variant_size_v<Shape>));
  }
  shapes.push_back(TriangleMesh{std::make_shared<const Mesh>(
      BallMesh(12, 24, [](const Eigen::Vector3d& d) { return 0.3 + 0.05 * d.x() * d.y(); }))});
  return shapes;
}

struct Asking {
  Robot robot;
  Pose from, to;
  double lasts_s;
};

MotionOptions Options() {
  MotionOptions options;
  options.check.unknown = UnknownPolicy::kFree;
  return options;
}

MotionAnswer AnswerOf(const SceneChecker& checker, const Pose& from, const Pose& to,
                      double lasts_s) {
  const auto reply = checker.CheckMotions(
      {{2}, {kTestStart, kTestStart + FromSeconds(lasts_s)}, {from, to}, {}}, Options());
  EXPECT_TRUE(reply.ok()) << reply.status();
  return reply.ok() ? reply->answers[0] : MotionAnswer{};
}

MotionAnswer AnswerTo(const ScenePtr& scene, const Asking& asking) {
  return AnswerOf(SceneChecker(scene, asking.robot), asking.from, asking.to, asking.lasts_s);
}

TEST(TurningMotion, BoxesOverFlatGroundAreFree) {
  Random random(1);
  for (const double gap_m : kGaps_m) {
    int unresolved = 0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d size = random.Vector(0.4).cwiseAbs() + Eigen::Vector3d::Constant(0.2);
      const double lasts_s = random.Uniform(0.5, 6), z_m = gap_m + 0.5 * size.z();
      const Eigen::Quaterniond from = About(Eigen::Vector3d::UnitZ(), random.Uniform(-3, 3));
      const double turn_rad = std::clamp(random.Uniform(-3, 3) * lasts_s, -3.1, 3.1);
      const Asking asking{Robot::SingleShape("box", Box{size}),
                          {from, {random.Uniform(-2, 2), random.Uniform(-2, 2), z_m}},
                          {from * About(Eigen::Vector3d::UnitZ(), turn_rad),
                           {random.Uniform(-2, 2), random.Uniform(-2, 2), z_m}},
                          lasts_s};
      unresolved += AnswerTo(Floor(), asking).status != SpaceStatus::kFree;
    }
    EXPECT_EQ(unresolved, 0) << gap_m;
  }
}

TEST(TurningMotion, AllKindsOfShapesOverFlatGroundAreFree) {
  Random random(2);
  const std::vector<Shape> shapes = ShapesOfAllKinds();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const double gap_m : kGaps_m) {
      // Lying in any way; the shape turns about the vertical.
      const Eigen::Quaterniond lies = About(random.UnitVector(), random.Uniform(0, 3));
      const double z_m = gap_m + Below(shapes[i], lies);
      const Asking asking{Robot::SingleShape("shape", shapes[i]),
                          {lies, {-1, random.Uniform(-1, 1), z_m}},
                          {About(Eigen::Vector3d::UnitZ(), 3) * lies, {1, 0.3, z_m}},
                          2};
      EXPECT_EQ(AnswerTo(Floor(), asking).status, SpaceStatus::kFree) << i << " at " << gap_m;
    }
  }
}

// The floor as an object, of voxels and as a given shape, at any slope.
TEST(TurningMotion, AboutTheNormalOfASlopeIsFree) {
  Random random(3);
  const std::vector<Shape> shapes = ShapesOfAllKinds();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const double gap_m : kGaps_m) {
      const Pose T_W_O = random.AnyPose(2);
      const Eigen::Quaterniond lies = About(random.UnitVector(), random.Uniform(0, 3));
      const double z_m = gap_m + Below(shapes[i], lies);
      const Pose from_O{lies, {-0.5, 0, z_m}};
      const Pose to_O{About(Eigen::Vector3d::UnitZ(), -3) * lies, {0.5, 0, z_m}};
      TestWorld given, voxels;
      given.Given(1, Box{{4, 4, 1}}, T_W_O * Pose::Translation(0, 0, -0.5));
      voxels.Object(1, VoxelCuboid({-20, -20, -2}, {20, 20, 0}), T_W_O);
      const Asking asking{Robot::SingleShape("shape", shapes[i]), T_W_O * from_O, T_W_O * to_O, 2};
      EXPECT_EQ(AnswerTo(given.Scene(), asking).status, SpaceStatus::kFree) << i << ", " << gap_m;
      EXPECT_EQ(AnswerTo(voxels.Scene(), asking).status, SpaceStatus::kFree) << i << ", " << gap_m;
    }
  }
}

// What turns may be the object, or both.
TEST(TurningMotion, OfAnObjectUnderARobotIsFree) {
  Random random(4);
  const std::vector<Shape> shapes = ShapesOfAllKinds();
  const Twist turning{.angular = {0, 0, 1.5}, .linear = {0, 0, 0}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const double gap_m : kGaps_m) {
      const double z_m = gap_m + Below(shapes[i], Eigen::Quaterniond::Identity());
      TestWorld given, voxels;
      given.Given(1, Box{{3, 3, 1}}, Pose::Translation(0, 0, -0.5), turning);
      voxels.Object(1, VoxelCuboid({-15, -15, -2}, {15, 15, 0}), Pose{}, turning);
      for (const double turn_rad : {0.0, 2.0}) {
        const Asking asking{Robot::SingleShape("shape", shapes[i]),
                            Pose::Translation(0.2, 0, z_m),
                            {About(Eigen::Vector3d::UnitZ(), turn_rad), {0.2, 0, z_m}},
                            2};
        EXPECT_EQ(AnswerTo(given.Scene(), asking).status, SpaceStatus::kFree) << i << " " << gap_m;
        EXPECT_EQ(AnswerTo(voxels.Scene(), asking).status, SpaceStatus::kFree) << i << " " << gap_m;
      }
    }
  }
}

// Upright cylinders that turn in place change nothing at all, beside a wall, too.
TEST(TurningMotion, OfARoundRobotBesideAWallIsFree) {
  for (const double gap_m : kGaps_m) {
    TestWorld world;
    world.Occupied({{-3, -3, -0.1}, {3, 3, 0}}).Occupied({{0.5, -3, 0}, {0.6, 3, 2}});
    const Asking asking{Robot::SingleShape("round", Cylinder{0.3, 1}),
                        Pose::Translation(0.2 - gap_m, -2, 0.5 + gap_m),
                        {About(Eigen::Vector3d::UnitZ(), 3), {0.2 - gap_m, 2, 0.5 + gap_m}},
                        4};
    EXPECT_EQ(AnswerTo(world.Scene(), asking).status, SpaceStatus::kFree) << gap_m;
  }
}

// Over the floor and, with a corner that goes by, near a wall.
TEST(TurningMotion, OfABoxBesideAWallEndsWhereItsCornerTouches) {
  const double half_diagonal_m = std::hypot(0.5, 0.35);
  for (const double gap_m : {2e-4, 1e-3, 1e-2}) {
    TestWorld world;
    world.Occupied({{-3, -3, -0.1}, {3, 3, 0}}).Occupied({{1, -3, 0}, {1.1, 3, 2}});
    const auto ask = [&](double from_wall_m) {
      const double x_m = 1 - half_diagonal_m - from_wall_m;
      return AnswerTo(world.Scene(), {Robot::SingleShape("box", Box{{1, 0.7, 1}}),
                                      Pose::Translation(x_m, 0, 0.5 + gap_m),
                                      {About(Eigen::Vector3d::UnitZ(), 3), {x_m, 0, 0.5 + gap_m}},
                                      3})
          .status;
    };
    EXPECT_EQ(ask(gap_m), SpaceStatus::kFree) << gap_m;
    EXPECT_EQ(ask(-gap_m), SpaceStatus::kOccupied) << gap_m;
  }
}

// What is called free is free at many times, and witnesses are in contact, where random shapes turn
// about random axes close to a floor, a wall, a slope and an object that turns.
TEST(TurningMotion, NothingCalledFreeIsInContact) {
  ProofCounts counts;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    RandomWorld world(seed);
    Random random(seed);
    TestWorld made;
    made.Occupied({{-2, -2, -0.1}, {2, 2, 0}}).Occupied({{1.2, -2, 0}, {1.3, 2, 1}});
    made.Given(1, Box{{2, 2, 0.2}}, {About(Eigen::Vector3d::UnitY(), 0.4), {-1.5, 0, 0}});
    made.Given(2, Box{{0.6, 0.3, 0.3}}, Pose::Translation(0, 0.8, 0.15),
               Twist{.angular = {0, 0, random.Uniform(-2, 2)}, .linear = random.Vector(0.2)});
    const Robot robot = Robot::SingleShape("shape", world.AnyShape());
    const SceneChecker checker(made.Scene(), robot);
    Asked asked{{}, 1};
    for (int m = 0; m < 20; ++m) {
      const Eigen::Vector3d axis =
          m % 2 == 0 ? (Eigen::Vector3d::UnitZ() + random.Vector(0.02)).normalized()
                     : random.UnitVector();
      const Eigen::Quaterniond lies = About(random.UnitVector(), random.Uniform(0, 3));
      const double z_m =
          Below(robot.links[0].shapes[0].shape, lies) + random.Uniform(0, m % 3 == 0 ? 1e-3 : 0.03);
      asked.motions.knot_counts.push_back(2);
      asked.motions.times.push_back(TestTime(random.Uniform(0, 0.5)));
      asked.motions.times.push_back(TestTime(random.Uniform(0.6, 2)));
      const Eigen::Vector3d at(random.Uniform(-1.5, 1.2), random.Uniform(-1, 1), z_m);
      asked.motions.T_W_L.push_back({lies, at});
      asked.motions.T_W_L.push_back(
          {About(axis, random.Uniform(-3, 3)) * lies,
           at + Eigen::Vector3d(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                m % 4 == 0 ? 0 : random.Uniform(-0.01, 0.01))});
    }
    TryProofs(checker, asked, Options(), 200, 20, counts);
  }
  std::cout << counts.motions << " motions, " << counts.free << " free, " << counts.unresolved
            << " unresolved\n";
  EXPECT_EQ(counts.free_in_contact, 0);
  EXPECT_EQ(counts.witnesses_free, 0);
  EXPECT_GT(counts.looked_at, counts.motions / 2);
  EXPECT_GT(counts.free, counts.motions / 20);
}

// The promise of MotionAnswer::status: what is never nearer than a sixtieth of the resolution is
// proved free, whatever turns about whatever axis.
TEST(TurningMotion, WhatIsFartherThanASixtiethOfTheResolutionIsResolved) {
  int unresolved = 0, free = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    RandomWorld world(seed);
    Random random(seed);
    MotionOptions options = Options();
    options.contact_resolution_m = std::pow(10, random.Uniform(-3, -1));
    const Robot robot = Robot::SingleShape("shape", world.AnyShape());
    const SceneChecker checker(Floor(), robot);
    Asked asked{{}, 1};
    const Eigen::Quaterniond lies = About(random.UnitVector(), random.Uniform(0, 3));
    asked.motions.knot_counts = {2};
    asked.motions.times = {TestTime(0), TestTime(random.Uniform(0.1, 3))};
    asked.motions.T_W_L = {
        {lies, {random.Uniform(-1, 1), 0, 1}},
        {About(random.UnitVector(), random.Uniform(-3, 3)) * lies, {random.Uniform(-1, 1), 0, 1}}};
    // Lowered until it is that far away where it is lowest; then no look may have missed the
    // lowest.
    std::vector<Time> times;
    constexpr int kLooks = 2000;
    for (int i = 0; i <= kLooks; ++i) {
      times.push_back(asked.motions.times[0] +
                      (asked.motions.times[1] - asked.motions.times[0]) * i / kLooks);
    }
    const StateBatch states = StatesAt(asked, 0, 2, times);
    const ShapeGeometry geometry(robot.links[0].shapes[0].shape);
    double lowest_m = 1;
    for (const Pose& T_W_L : states.T_W_L) {
      lowest_m = std::min(lowest_m, PlacedShape(geometry, T_W_L).box_F().min.z());
    }
    const double gap_m = options.contact_resolution_m / 60 * random.Uniform(1.1, 2);
    for (Pose& T_W_L : asked.motions.T_W_L) T_W_L.translation.z() -= lowest_m - gap_m;
    const auto reply = checker.CheckMotions(asked.motions, options);
    ASSERT_TRUE(reply.ok()) << reply.status();
    unresolved += reply->answers[0].status == SpaceStatus::kUnresolved;
    free += reply->answers[0].status == SpaceStatus::kFree;
    EXPECT_NE(reply->answers[0].status, SpaceStatus::kUnresolved)
        << seed << " " << robot.links[0].shapes[0].shape.index() << " "
        << options.contact_resolution_m << " " << gap_m;
  }
  EXPECT_EQ(unresolved, 0);
  EXPECT_GE(free, 398);  // two may have been lowest between looks
}

// Touching is one thing for states and for motions that rest, glide or turn.
TEST(Touching, IsTheSameForStatesAndMotions) {
  const std::vector<Shape> shapes = ShapesOfAllKinds();
  TestWorld world;
  world.Occupied({{-3, -3, -0.1}, {3, 3, 0}})
      .Given(1, Box{{6, 6, 1}}, Pose::Translation(0, 0, 9.5));
  SceneParams params;
  params.keep_out_W = {{{-3, -3, 19}, {3, 3, 20}}};
  TestWorld kept_out(params);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double below_m = Below(shapes[i], Eigen::Quaterniond::Identity());
    const Robot robot = Robot::SingleShape("shape", shapes[i]);
    for (const auto& [scene, top_m] :
         {std::pair{world.Scene(), 0.0}, {world.Scene(), 10.0}, {kept_out.Scene(), 20.0}}) {
      const SceneChecker checker(scene, robot);
      for (const double gap_m : {-1e-6, -1e-9, 0.0, 1e-15, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
        const Pose at = Pose::Translation(0, 0, top_m + below_m + gap_m);
        const auto state = checker.Check({{kTestStart}, {at}}, Options().check);
        ASSERT_TRUE(state.ok()) << state.status();
        const bool free = state->answers[0].status == SpaceStatus::kFree;
        EXPECT_EQ(free, gap_m > 5e-7) << i << " " << top_m << " " << gap_m;
        const SpaceStatus expected = free ? SpaceStatus::kFree : SpaceStatus::kOccupied;
        Pose glides = at, turns = at;
        glides.translation.x() += 1;
        turns.rotation = About(Eigen::Vector3d::UnitZ(), 2);
        for (const Pose& to : {at, glides, turns}) {
          EXPECT_EQ(AnswerOf(checker, at, to, 1).status, expected)
              << i << " " << top_m << " " << gap_m;
        }
      }
    }
  }
}

// At the bounds, and up to rounding beyond them, is inside.
TEST(Touching, OfTheBoundsIsTheSameForStatesAndMotions) {
  SceneParams params;
  params.bounds_W = {{-3, -3, 0.3}, {3, 3, 3}};
  const ScenePtr scene = TestWorld(params).Scene();
  const std::vector<Shape> shapes = ShapesOfAllKinds();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double below_m = Below(shapes[i], Eigen::Quaterniond::Identity());
    const Robot robot = Robot::SingleShape("shape", shapes[i]);
    const SceneChecker checker(scene, robot);
    for (const double gap_m : {-1e-5, -1e-6, -1e-15, 0.0, 1e-15, 1e-8, 1e-7, 1e-6}) {
      const Pose at = Pose::Translation(0, 0, 0.3 + below_m + gap_m);
      const auto state = checker.Check({{kTestStart}, {at}}, Options().check);
      const bool free = state->answers[0].status == SpaceStatus::kFree;
      EXPECT_EQ(free, gap_m > -5e-7) << i << " " << gap_m;
      Pose glides = at, turns = at;
      glides.translation.x() += 1;
      turns.rotation = About(Eigen::Vector3d::UnitZ(), 2);
      for (const Pose& to : {at, glides, turns}) {
        EXPECT_EQ(AnswerOf(checker, at, to, 1).status,
                  free ? SpaceStatus::kFree : SpaceStatus::kOutOfBounds)
            << i << " " << gap_m;
      }
    }
  }
}

}  // namespace
}  // namespace clearway
