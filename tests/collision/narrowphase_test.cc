#include "collision/narrowphase.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clearway/geometry/distance.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

constexpr double kFar = 100;
const Aabb kAround{{-1, -1, -1}, {1, 1, 1}};

Aabb BoxAt(const Eigen::Vector3d& center, double size_m) {
  return {center.array() - size_m / 2, center.array() + size_m / 2};
}

Eigen::Vector3d NearestInCylinder(const Cylinder& c, const Eigen::Vector3d& p) {
  const double rho = std::hypot(p.x(), p.y());
  const double shrink = rho > c.radius_m ? c.radius_m / rho : 1;
  return {p.x() * shrink, p.y() * shrink, std::clamp(p.z(), -c.length_m / 2, c.length_m / 2)};
}

// By alternating projections, which from any start close in on the nearest pair of two convex sets
// from above (Cheney and Goldstein, 1959).
double CylinderBoxDistance(const Cylinder& c, const Pose& T_F_G, const Aabb& box_F) {
  const Pose T_G_F = Inverse(T_F_G);
  Eigen::Vector3d in_box = box_F.Center(), in_cylinder;
  for (int i = 0; i < 3000; ++i) {
    in_cylinder = T_F_G * NearestInCylinder(c, T_G_F * in_box);
    in_box = in_cylinder.cwiseMax(box_F.min).cwiseMin(box_F.max);
  }
  return (in_box - in_cylinder).norm();
}

TEST(NarrowphaseTest, Empty) {
  const ShapeGeometry dut(Sphere{0.5});
  const PlacedShape placed(dut, Pose::Translation(1, 2, 3));
  EXPECT_EQ(placed.box_F(), (Aabb{{0.5, 1.5, 2.5}, {1.5, 2.5, 3.5}}));
}

TEST(NarrowphaseTest, BoxesAroundShapesAreTheSmallest) {
  RandomWorld random(1);
  for (int i = 0; i < 60; ++i) {
    const ShapeGeometry geometry(random.ShapeOfKind(i % std::variant_size_v<Shape>));
    const PlacedShape dut(geometry, random.AnyPose(kAround));
    for (int axis = 0; axis < 3; ++axis) {
      // A large box just off each side does not touch, and just within it does.
      for (double side : {-1.0, 1.0}) {
        const double face = side < 0 ? dut.box_F().min[axis] : dut.box_F().max[axis];
        Eigen::Vector3d center = dut.box_F().Center();
        center[axis] = face + side * (5 + 1e-5);
        EXPECT_GT(dut.DistanceTo(BoxAt(center, 10), kFar), 0);
        center[axis] = face + side * (5 - 1e-5);
        EXPECT_EQ(dut.DistanceTo(BoxAt(center, 10), kFar), 0);
      }
    }
  }
}

TEST(NarrowphaseTest, CylinderDistancesAreGoodToAMicrometre) {
  RandomWorld random(2);
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const Cylinder cylinder{random.Uniform(0.05, 0.4), random.Uniform(0.1, 1)};
    const ShapeGeometry geometry(cylinder);
    const Pose T_F_G = random.AnyPose(kAround);
    const Aabb box = BoxAt(random.Point(kAround), 0.1);
    const double expected_m = CylinderBoxDistance(cylinder, T_F_G, box);
    if (expected_m < 1e-3) continue;  // the projections are slow there
    ++apart;
    EXPECT_NEAR(PlacedShape(geometry, T_F_G).DistanceTo(box, kFar), expected_m, 1e-6);
  }
  EXPECT_GT(apart, 150);
}

// A capsule is a ball rolled along a segment; a ball against a box has a simple form.
TEST(NarrowphaseTest, CapsuleDistancesAreThoseOfItsBalls) {
  RandomWorld random(3);
  for (int i = 0; i < 200; ++i) {
    const Capsule capsule{random.Uniform(0.02, 0.1), random.Uniform(0.1, 1)};
    const ShapeGeometry geometry(capsule);
    const Pose T_F_G = random.AnyPose(kAround);
    const Aabb box = BoxAt(random.Point(kAround), 0.1);
    double nearest_m = kFar;
    constexpr int kSteps = 2000;
    for (int step = 0; step <= kSteps; ++step) {
      const double z = capsule.length_m * (static_cast<double>(step) / kSteps - 0.5);
      nearest_m = std::min(nearest_m, PointBoxDistance(T_F_G * Eigen::Vector3d(0, 0, z), box));
    }
    const double expected_m = std::max(0.0, nearest_m - capsule.radius_m);
    const double found_m = PlacedShape(geometry, T_F_G).DistanceTo(box, kFar);
    EXPECT_LE(found_m, expected_m + 1e-12);
    EXPECT_GE(found_m, expected_m - capsule.length_m / kSteps);
  }
}

// Boxes, hulls and meshes of the same cube are the same body.
TEST(NarrowphaseTest, ACubeIsACubeInEveryForm) {
  RandomWorld random(4);
  const ShapeGeometry box(Box{{1, 1, 1}}), hull(ConvexPolytope{CubeMesh(0.5)}),
      mesh(TriangleMesh{CubeMesh(0.5)});
  const ShapeGeometry obstacle(ConvexPolytope{CubeMesh(0.2)});
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose T_F_G = random.AnyPose(kAround), T_F_H = random.AnyPose(kAround);
    const Aabb voxel = BoxAt(random.Point(kAround), 0.2);
    const Eigen::Vector3d center = random.Point(kAround);
    const PlacedShape reference(box, T_F_G);
    const double to_box_m = reference.DistanceTo(voxel, kFar);
    const double to_hull_m = reference.DistanceToShape(obstacle, T_F_H, kFar);
    const double to_ball_m = reference.DistanceToBall(center, 0.2, kFar);
    apart += to_box_m > 0;
    for (const ShapeGeometry* other : {&hull, &mesh}) {
      const PlacedShape dut(*other, T_F_G);
      EXPECT_NEAR(dut.DistanceTo(voxel, kFar), to_box_m, 1e-8);
      EXPECT_NEAR(dut.DistanceToShape(obstacle, T_F_H, kFar), to_hull_m, 1e-8);
      EXPECT_NEAR(dut.DistanceToBall(center, 0.2, kFar), to_ball_m, 1e-8);
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_LT(apart, 290);
}

TEST(NarrowphaseTest, DistancesAreExactUpToTheLimitAndAboveItBeyond) {
  RandomWorld random(5);
  const ShapeGeometry obstacle(ConvexPolytope{CubeMesh(0.2)});
  for (int i = 0; i < 300; ++i) {
    const ShapeGeometry geometry(random.ShapeOfKind(i % std::variant_size_v<Shape>));
    const PlacedShape dut(geometry, random.AnyPose(kAround));
    const Aabb voxel = BoxAt(random.Point(kAround), 0.2);
    const Pose T_F_H = random.AnyPose(kAround);
    const double limit_m = random.Uniform(0, 0.5);
    const auto check = [&](double exact_m, double found_m) {
      EXPECT_EQ(found_m > limit_m, exact_m > limit_m);
      if (exact_m <= limit_m) {
        EXPECT_NEAR(found_m, exact_m, 1e-8);
      }
    };
    check(dut.DistanceTo(voxel, kFar), dut.DistanceTo(voxel, limit_m));
    check(dut.DistanceToShape(obstacle, T_F_H, kFar),
          dut.DistanceToShape(obstacle, T_F_H, limit_m));
    const Eigen::Vector3d center = T_F_H.translation;
    check(dut.DistanceToBall(center, 0.1, kFar), dut.DistanceToBall(center, 0.1, limit_m));
  }
}

TEST(NarrowphaseTest, NothingIsLostFarFromTheOrigin) {
  const Eigen::Vector3d far(9e4, -8e4, 1e3);
  for (const Shape& shape :
       {Shape{Box{{1, 1, 1}}}, Shape{Cylinder{0.5, 1}}, Shape{ConvexPolytope{CubeMesh(0.5)}},
        Shape{TriangleMesh{CubeMesh(0.5)}}}) {
    const ShapeGeometry geometry(shape);
    const PlacedShape dut(geometry, {Eigen::Quaterniond::Identity(), far});
    EXPECT_NEAR(dut.DistanceTo(BoxAt(far + Eigen::Vector3d(1.25, 0.1, 0), 0.5), kFar), 0.5, 1e-8);
  }
}

TEST(NarrowphaseTest, AnEdgeOfAMeshThatIsOpenIsNoInside) {
  const auto square = std::make_shared<const Mesh>(
      Mesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const ShapeGeometry geometry(TriangleMesh{square});
  const PlacedShape dut(geometry, Pose{});
  EXPECT_NEAR(dut.DistanceTo(BoxAt({0, 0, 0.5}, 0.2), kFar), 0.4, 1e-9);
  EXPECT_EQ(dut.DistanceTo(BoxAt({0, 0, 0.05}, 0.2), kFar), 0);
}

}  // namespace
}  // namespace clearway
