#include "collision/parallel_cylinders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clearway/geometry/distance.h"
#include "collision/advance.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

const Aabb kAround{{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}};

// By alternating projections (Cheney and Goldstein, 1959).
double DistanceByProjections(const Cylinder& first, const Cylinder& second,
                             const Eigen::Vector3d& to_first) {
  Eigen::Vector3d in_first = to_first, in_second;
  for (int i = 0; i < 3000; ++i) {
    in_second = NearestPoint(in_first, second);
    in_first = to_first + NearestPoint(in_second - to_first, first);
  }
  return (in_first - in_second).norm();
}

Cylinder AnyCylinder(RandomWorld& random) {
  return {random.Uniform(0.1, 0.6), random.Uniform(0.1, 1)};
}

// Turned about its axis, or upside down.
Pose AnyUpright(RandomWorld& random) {
  const Eigen::AngleAxisd turn(random.Uniform(-3, 3), Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd over(random.Below(2) * M_PI, Eigen::Vector3d::UnitX());
  return {Eigen::Quaterniond(turn * over), random.Point(kAround)};
}

TEST(ParallelCylinders, AreNoneIfTheAxesAreNotParallel) {
  const Pose leaning{Eigen::Quaterniond(Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitX())),
                     {1, 0, 0}};
  EXPECT_FALSE(ParallelCylinders::Of({1, 1}, {1, 1}, leaning));
  const Pose not_a_number{Eigen::Quaterniond(NAN, 0, 0, 0), {1, 0, 0}};
  EXPECT_FALSE(ParallelCylinders::Of({1, 1}, {1, 1}, not_a_number));
}

TEST(ParallelCylinders, DistancesAreThoseOfNearestPoints) {
  RandomWorld random(1);
  int apart = 0;
  for (int i = 0; i < 500; ++i) {
    const Cylinder first = AnyCylinder(random), second = AnyCylinder(random);
    const Pose T_second_first = AnyUpright(random);
    const auto dut = ParallelCylinders::Of(first, second, T_second_first);
    ASSERT_TRUE(dut) << i;
    EXPECT_NEAR(dut->Distance(), DistanceByProjections(first, second, T_second_first.translation),
                1e-9);
    apart += dut->Distance() > 0;
  }
  EXPECT_GT(apart, 200);
  EXPECT_LT(apart, 480);
}

// What is kept of the touching distance is all that lies between "before" and "touched".
TEST(ParallelCylinders, NothingIsCloserBeforeTheFirstTouchAndSomethingIsThere) {
  RandomWorld random(2);
  int touched = 0, never = 0, rims = 0, level = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Cylinder first = AnyCylinder(random), second = AnyCylinder(random);
    Eigen::Vector3d way = 2 * random.Point(kAround);
    if (i % 2 == 0) way.z() = 0;
    if (i % 7 == 0) way.head<2>().setZero();
    const double margin_m = i % 3 == 0 ? 0 : random.Uniform(0, 0.3);
    const double until = i % 5 == 0 ? random.Uniform(0, 1) : 1;
    const Pose begin = AnyUpright(random);
    const auto distance_m = [&](double share) {
      const Pose there{begin.rotation, begin.translation + share * way};
      return ParallelCylinders::Of(first, second, there)->Distance();
    };
    const auto share =
        ParallelCylinders::Of(first, second, begin)->FirstTouch(way, margin_m, until);
    if (!share) {
      ++rims;
      continue;
    }
    for (int step = 0; step < 40 && *share > 0; ++step) {
      const double at = std::min(*share, until) * step / 40;
      ASSERT_GT(distance_m(at), margin_m + 0.9 * kKept_m) << i;
    }
    if (*share == kNever) {
      ASSERT_GT(distance_m(until), margin_m + 0.9 * kKept_m) << i;
      ++never;
    } else {
      ASSERT_LE(*share, until);
      ASSERT_LE(distance_m(*share), margin_m + 1.1 * kKept_m) << i;
      ++touched;
      level += way.z() == 0;
    }
  }
  EXPECT_GT(touched, 3'000);
  EXPECT_GT(never, 3'000);
  EXPECT_GT(level, 1'000);
  EXPECT_GT(rims, 100);
  EXPECT_LT(rims, 2'000);
}

TEST(ParallelCylinders, WhatIsNotANumberIsNotAnswered) {
  const auto dut = ParallelCylinders::Of({1, 1}, {1, 1}, Pose::Translation(3, 0, 0));
  const auto touch = dut->FirstTouch({NAN, 0, 0}, 0, 1);
  EXPECT_FALSE(touch && *touch == kNever);
}

}  // namespace
}  // namespace clearway
