// Separations and sweeps against FCL's distances.
#include "collision/body_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "clearway/geometry/hull.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

constexpr double kFar = 100, kUnsure_m = 1e-7;
const Aabb kAround{{-1, -1, -1}, {1, 1, 1}};

ShapeGeometry AnyHull(RandomWorld& random) {
  const double size_m = random.Uniform(0.1, 0.5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 4 + random.Below(60); i > 0; --i) points.push_back(size_m * random.Point(kAround));
  return ShapeGeometry(ConvexPolytope{std::make_shared<const Mesh>(ConvexHullOf(points))});
}

// A hull as FCL sees it at a pose, and as a body.
struct Obstacle {
  explicit Obstacle(RandomWorld& random)
      : hull(AnyHull(random)),
        T_F_H(random.AnyPose(kAround)),
        R_F_H(T_F_H.rotation.toRotationMatrix()) {}
  Eigen::Vector3d operator()(const Eigen::Vector3d& direction_F) const {
    return R_F_H * hull.FarthestOfCore(R_F_H.transpose() * direction_F) + T_F_H.translation;
  }
  Eigen::Vector3d center_F() const { return T_F_H * hull.box_G().Center(); }

  ShapeGeometry hull;
  Pose T_F_H;
  Eigen::Matrix3d R_F_H;
};

TEST(FindSeparation, OfTwoPoints) {
  const Eigen::Vector3d a(1, 2, 3), b(1, 2, 5);
  const Separation apart =
      FindSeparation([&](const auto&) { return a; }, [&](const auto&) { return b; },
                     Eigen::Vector3d::UnitX(), 0, [](const Separation&) { return false; });
  EXPECT_NEAR(apart.gap_m, 2, 1e-8);
  EXPECT_NEAR(apart.at_most_m, 2, 1e-8);
  EXPECT_NEAR((apart.direction - Eigen::Vector3d::UnitZ()).norm(), 0, 1e-6);
}

TEST(FindSeparation, BoundsTheDistanceOnBothSides) {
  RandomWorld random(1);
  int apart = 0, meeting = 0;
  for (int i = 0; i < 3000; ++i) {
    const ShapeGeometry geometry(random.ShapeOfKind(i % std::variant_size_v<Shape>));
    if (!geometry.convex()) continue;
    const PlacedShape shape(geometry, random.AnyPose(kAround));
    const Obstacle obstacle(random);
    const double exact_m = shape.DistanceToShape(obstacle.hull, obstacle.T_F_H, kFar);
    const Separation found = FindSeparation(
        [&](const Eigen::Vector3d& direction) { return shape.FarthestOfCore(direction); }, obstacle,
        random.Point(kAround), 0, [](const Separation&) { return false; });
    const double radius_m = geometry.core_radius_m();
    EXPECT_LE(found.gap_m - radius_m, exact_m + kUnsure_m);
    EXPECT_GE(std::max(0.0, found.at_most_m - radius_m), exact_m - kUnsure_m);
    if (exact_m > 1e-3) {
      ++apart;
      EXPECT_NEAR(found.direction.norm(), 1, 1e-12);
      EXPECT_GE(found.gap_m, 0.97 * (exact_m + radius_m));
    } else if (exact_m == 0 && radius_m == 0) {
      ++meeting;
      EXPECT_LE(found.at_most_m, kUnsure_m);
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(meeting, 100);
}

// Meshes too, those of the random world being closed.
TEST(BodyContact, MeetsIfTheDistanceIsWithinTheMargin) {
  RandomWorld random(2);
  int meeting = 0, apart = 0, unsure = 0;
  for (int i = 0; i < 3000; ++i) {
    const ShapeGeometry geometry(random.ShapeOfKind(i % std::variant_size_v<Shape>));
    const PlacedShape shape(geometry, random.AnyPose(kAround));
    const Obstacle obstacle(random);
    const double margin_m = i % 3 == 0 ? 0 : random.Uniform(0, 0.3);
    const double exact_m = shape.DistanceToShape(obstacle.hull, obstacle.T_F_H, kFar);
    const auto meets = Meets(shape, {obstacle, obstacle.center_F()}, margin_m);
    if (!meets) {
      ++unsure;
      continue;
    }
    if (std::abs(exact_m - margin_m) < kUnsure_m && exact_m > 0) continue;
    EXPECT_EQ(*meets, exact_m <= margin_m) << i << ": " << exact_m << " m, margin " << margin_m;
    ++(*meets ? meeting : apart);
  }
  EXPECT_GT(meeting, 300);
  EXPECT_GT(apart, 300);
  EXPECT_LT(unsure, 300);
}

TEST(BodyContact, NothingIsTouchedBeforeTheFirstTouch) {
  RandomWorld random(3);
  int touched = 0, never = 0, close = 0;
  for (int i = 0; i < 1500; ++i) {
    const ShapeGeometry geometry(random.ShapeOfKind(i % std::variant_size_v<Shape>));
    const Pose T_F_G = random.AnyPose(kAround);
    const Obstacle obstacle(random);
    const double margin_m = i % 3 == 0 ? 0 : random.Uniform(0, 0.1);
    const Sweep sweep{PlacedShape(geometry, T_F_G), 2 * random.Point(kAround), margin_m};
    const double until = random.Below(2) == 0 ? 1 : random.Uniform(0, 1);
    const double share = FirstTouchOf(sweep, {obstacle, obstacle.center_F()}, 0, 0, until);
    const auto distance_m = [&](double at) {
      const Pose T_F_G_there{T_F_G.rotation, T_F_G.translation + at * sweep.way_F};
      return PlacedShape(geometry, T_F_G_there)
          .DistanceToShape(obstacle.hull, obstacle.T_F_H, kFar);
    };
    const double last = std::min(share, until);
    for (int step = 0; step < 50 && last > 0; ++step) {
      ASSERT_GT(distance_m(step / 50.0 * last), margin_m - kUnsure_m) << i;
    }
    (share == kNever ? never : touched) += 1;
    if (share != kNever) close += distance_m(share) <= margin_m + 1e-3;
  }
  EXPECT_GT(never, 100);
  EXPECT_GT(touched, 100);
  EXPECT_GE(close, 0.98 * touched);
}

}  // namespace
}  // namespace clearway
