#include "sim/ray_caster.h"

#include <gtest/gtest.h>

#include <numbers>

#include "clearway/geometry/hull.h"
#include "sim/meshes.h"
#include "sim/ray_shape.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// One of each kind, about a metre in size.
std::vector<Shape> AllShapes() {
  const auto wedge = Extruded({{-0.6, -0.4}, {0.6, -0.4}, {-0.6, 0.4}}, 0.8);
  const auto hull = std::make_shared<const Mesh>(ConvexHullOf(wedge->vertices));
  return {Sphere{0.5},        Box{{1.2, 0.7, 0.4}}, Capsule{0.3, 0.6},
          Cylinder{0.4, 0.9}, ConvexPolytope{hull}, TriangleMesh{wedge}};
}

RayHit CastOne(const World& world, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               double max_range_m = 50) {
  const std::vector<Eigen::Vector3d> directions = {direction};
  return RayCaster(world).Cast({Eigen::Quaterniond::Identity(), origin}, Time(), directions,
                               max_range_m)[0];
}

TEST(RayCasterTest, EmptyWorldReturnsNothing) {
  EXPECT_EQ(CastOne(World(), {0, 0, 0}, {1, 0, 0}).range_m, kNoHit);
}

TEST(RayCasterTest, RangesToEachShapeAreExact) {
  const std::vector<double> expected_x = {0.5, 0.6, 0.3, 0.4};  // where they cross the x axis
  const std::vector<Shape> shapes = AllShapes();
  for (std::size_t i = 0; i < expected_x.size(); ++i) {
    const World world({Body::Single(0, "", shapes[i], FixedPose{})});
    EXPECT_NEAR(CastOne(world, {-4, 0, 0}, {1, 0, 0}).range_m, 4 - expected_x[i], 1e-12);
    EXPECT_EQ(CastOne(world, {-4, 0, 0}, {-1, 0, 0}).range_m, kNoHit);
    EXPECT_EQ(CastOne(world, {-4, 2, 0}, {1, 0, 0}).range_m, kNoHit);
  }
}

TEST(RayCasterTest, SeenFromInsideIsWhereTheRayLeaves) {
  const World world({Body::Single(0, "", Box{{2, 4, 6}}, FixedPose{})});
  EXPECT_NEAR(CastOne(world, {0, 0, 0}, {1, 0, 0}).range_m, 1, 1e-12);
  EXPECT_NEAR(CastOne(world, {0, 0, 0}, {0, 0, -1}).range_m, 3, 1e-12);
}

TEST(RayCasterTest, BeyondTheMaximumRangeThereIsNothing) {
  const World world({Body::Single(0, "", Box{{2, 2, 2}}, FixedPose{})});
  EXPECT_EQ(CastOne(world, {-6, 0, 0}, {1, 0, 0}, 4.9).range_m, kNoHit);
  EXPECT_NEAR(CastOne(world, {-6, 0, 0}, {1, 0, 0}, 5.1).range_m, 5, 1e-12);
}

TEST(RayCasterTest, TheNearestBodyCounts) {
  const World world({Body::Single(0, "", Box{{1, 1, 1}}, FixedPose{Pose::Translation(6, 0, 0)}),
                     Body::Single(7, "", Sphere{0.5}, FixedPose{Pose::Translation(3, 0, 0)})});
  const RayHit hit = CastOne(world, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(hit.body, 1u);
  EXPECT_NEAR(hit.range_m, 2.5, 1e-12);
}

TEST(RayCasterTest, OfEqualSurfacesTheFirstBodyCounts) {
  const Body near = Body::Single(1, "", Box{{1, 1, 1}}, FixedPose{Pose::Translation(3, 0, 0)});
  const Body large = Body::Single(2, "", Box{{1, 9, 9}}, FixedPose{Pose::Translation(3, 0, 0)});
  EXPECT_EQ(CastOne(World({near, large}), {0, 0, 0}, {1, 0, 0}).body, 0u);
  EXPECT_EQ(CastOne(World({large, near}), {0, 0, 0}, {1, 0, 0}).body, 0u);
}

TEST(RayCasterTest, BodiesAreCastWhereTheyAreAtTheTime) {
  const World world(
      {Body::Single(1, "", Box{{1, 1, 1}},
                    ConstantTwist{Pose::Translation(3, 0, 0), {{0, 0, 0}, {2, 0, 0}}, Time()})});
  const std::vector<Eigen::Vector3d> directions = {Eigen::Vector3d::UnitX()};
  EXPECT_NEAR(RayCaster(world).Cast(Pose(), Time(FromSeconds(2)), directions, 50)[0].range_m, 6.5,
              1e-12);
}

// Marching along the ray in small steps must find the same first surface, for every shape in any
// pose.
TEST(RayCasterTest, AgreesWithMarching) {
  constexpr double kStepM = 0.002;
  Random random(11);
  for (const Shape& shape : AllShapes()) {
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
      const Pose T_W_B = random.AnyPose(0.3);
      const World world({Body::Single(1, "", shape, FixedPose{T_W_B})});
      const WorldAtTime truth(world, Time());
      const Eigen::Vector3d origin = 2 * random.UnitVector();
      const Eigen::Vector3d direction = (random.Vector(0.5) - origin).normalized();
      double marched = 0;
      while (marched < 4 && !truth.ObjectAt(origin + marched * direction)) marched += kStepM;
      const double range_m = CastOne(world, origin, direction).range_m;
      if (marched >= 4) {
        // The march may step over a corner, but not over more than a step of it.
        if (range_m < 4) {
          EXPECT_FALSE(truth.ObjectAt(origin + (range_m + kStepM) * direction));
        }
        continue;
      }
      ++hits;
      EXPECT_LE(range_m, marched + 1e-9);
      EXPECT_GE(range_m, marched - 2 * kStepM);
    }
    EXPECT_GT(hits, 15);
  }
}

TEST(RayCasterTest, PolytopeAndMeshOfTheSameSolidAgree) {
  const std::vector<Shape> shapes = AllShapes();
  const World polytope({Body::Single(1, "", shapes[4], FixedPose{})});
  const World mesh({Body::Single(1, "", shapes[5], FixedPose{})});
  Random random(5);
  for (int i = 0; i < 1'000; ++i) {
    const Eigen::Vector3d origin = 2 * random.UnitVector();
    const Eigen::Vector3d direction = (random.Vector(0.5) - origin).normalized();
    const double a = CastOne(polytope, origin, direction).range_m;
    const double b = CastOne(mesh, origin, direction).range_m;
    if (a == kNoHit || b == kNoHit) {
      EXPECT_EQ(a, b);
    } else {
      EXPECT_NEAR(a, b, 1e-9);
    }
  }
}

}  // namespace
}  // namespace clearway
