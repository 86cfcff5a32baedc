// Boxes around turned points against a look at every point.
#include "collision/extreme_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;
using Points = std::vector<Eigen::Vector3d>;

// By how much the boxes found differ from the true ones at most; negative if one lacks a point.
double MostBeyond_m(const Points& points) {
  const ExtremePoints dut(points);
  Random random(1);
  double most_m = 0;
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix3d R_F_G = random.AnyPose(1).rotation.toRotationMatrix();
    if (i == 0) R_F_G.setIdentity();
    Aabb expected;
    for (const Eigen::Vector3d& point : points) expected.Extend(R_F_G * point);
    const Aabb found = dut.BoxTurned(R_F_G);
    const double least_m =
        std::min((expected.min - found.min).minCoeff(), (found.max - expected.max).minCoeff());
    if (least_m < -1e-12) return least_m;
    most_m = std::max(
        {most_m, (expected.min - found.min).maxCoeff(), (found.max - expected.max).maxCoeff()});
  }
  return most_m;
}

void ExpectExact(const Points& points) {
  const double beyond_m = MostBeyond_m(points);
  EXPECT_GE(beyond_m, 0);
  EXPECT_LT(beyond_m, 1e-12);
}

Points Scattered(int count, const Eigen::Vector3d& half_m) {
  Random random(2);
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(random.Vector(1).cwiseProduct(half_m));
  return points;
}

TEST(ExtremePointsTest, OnePoint) { ExpectExact({{0.1, -0.2, 0.3}}); }

TEST(ExtremePointsTest, PointsAllAtOnePlace) { ExpectExact(Points(20'000, {0.1, -0.2, 0.3})); }

TEST(ExtremePointsTest, ScatteredPoints) { ExpectExact(Scattered(5'000, {1, 2, 0.5})); }

TEST(ExtremePointsTest, ExactDuplicates) {
  Points points = Scattered(1'000, {1, 2, 0.5});
  for (int i = 0; i < 4; ++i) points.insert(points.end(), points.begin(), points.begin() + 1'000);
  ExpectExact(points);
}

TEST(ExtremePointsTest, PointsOnAPlane) { ExpectExact(Scattered(5'000, {1, 2, 0})); }

TEST(ExtremePointsTest, PointsOnALine) {
  Points points;
  for (int i = 0; i < 5'000; ++i) points.emplace_back(0.3e-3 * i, 0.5e-3 * i, -0.7e-3 * i);
  ExpectExact(points);
}

TEST(ExtremePointsTest, VeryManyPointsOnALineAreHeld) {
  Points points;
  for (int i = 0; i < 50'000; ++i) points.emplace_back(0.3e-4 * i, 0.5e-4 * i, -0.7e-4 * i);
  EXPECT_GE(MostBeyond_m(points), 0);
}

}  // namespace
}  // namespace clearway
