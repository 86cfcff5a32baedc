// Triangles against boxes and points, each against a slow and plain form.
#include "collision/triangle_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clearway/geometry/distance.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// By a search over all its points in terms of two nested sections, as the distance is convex.
double SlowPointTriangleDistance(const Eigen::Vector3d& p, const Triangle& t) {
  const auto least = [](double low, double high, const auto& f) {
    for (int i = 0; i < 120; ++i) {
      const double left = low + (high - low) / 3, right = high - (high - low) / 3;
      (f(left) < f(right) ? high : low) = f(left) < f(right) ? right : left;
    }
    return f(0.5 * (low + high));
  };
  return least(0, 1, [&](double v) {
    return least(0, 1 - v,
                 [&](double w) { return (t.a + v * (t.b - t.a) + w * (t.c - t.a) - p).norm(); });
  });
}

// Corners may coincide, lie on a line, or nearly so.
Triangle AnyTriangle(Random& random) {
  Triangle t{random.Vector(1), random.Vector(1), random.Vector(1)};
  const double thin_m = std::pow(10, -random.Uniform(1, 14));
  switch (random.Integer(0, 7)) {
    case 0:
      t.b = t.a + thin_m * random.UnitVector();
      break;
    case 1:
      t.c = t.a + random.Uniform(-1, 2) * (t.b - t.a) + thin_m * random.UnitVector();
      break;
    case 2:
      t.c = t.b;
      break;
    case 3:
      t.b = t.c = t.a;
      break;
    default:
      break;
  }
  return t;
}

TEST(PointTriangleDistanceTest, IsThatOfASearchForThinTrianglesToo) {
  Random random(1);
  for (int i = 0; i < 400; ++i) {
    const Triangle t = AnyTriangle(random);
    Eigen::Vector3d p = random.Vector(1.5);
    if (i % 3 == 0) p = 0.3 * t.a + 0.6 * t.b + 0.1 * t.c + 0.01 * random.Vector(1);
    EXPECT_NEAR(PointTriangleDistance(p, t.a, t.b, t.c), SlowPointTriangleDistance(p, t), 1e-7);
  }
}

// The lines from the corner c to the edge ab make up the triangle.
TEST(TriangleBoxTest, DistancesAreThoseOfASearchOverTheTriangle) {
  Random random(2);
  int apart = 0, meeting = 0;
  for (int i = 0; i < 400; ++i) {
    const Triangle t = AnyTriangle(random);
    const Eigen::Vector3d half_m = random.Vector(0.4).cwiseAbs().array() + 0.02;
    const OrientedBox box(random.Vector(0.7), random.AnyPose(1).rotation.toRotationMatrix(),
                          half_m);
    const Aabb around{-half_m, half_m};
    const auto to_edge = [&](double v) {
      const Eigen::Vector3d from = box.ToB(t.a + v * (t.b - t.a));
      return SegmentBoxDistance(from, box.ToB(t.c), around);
    };
    double expected_m = to_edge(1);
    constexpr int kSteps = 4000;
    for (int k = 0; k < kSteps; ++k) expected_m = std::min(expected_m, to_edge(1.0 * k / kSteps));
    const double found_m = Distance(t, box, 100);
    const double least_m = std::max(0.0, expected_m - (t.b - t.a).norm() / kSteps - 1e-9);
    if (least_m > 0) {
      EXPECT_GT(Distance(t, box, 0.9 * least_m), 0.9 * least_m);
    }
    EXPECT_LE(found_m, expected_m + 1e-9);
    EXPECT_GE(found_m, least_m);
    EXPECT_EQ(Meet(t, box), found_m == 0);
    apart += expected_m > 0;
    meeting += expected_m == 0;
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(meeting, 50);
}

}  // namespace
}  // namespace clearway
