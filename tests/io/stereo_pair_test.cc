#include "io/stereo_pair.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <random>

namespace clearway {
namespace {

using ::testing::HasSubstr;
using Projection = StereoPair::Projection;

Projection Camera(double f, double cx, double cy, const Eigen::Vector3d& center_S) {
  Projection projection;
  projection.leftCols<3>() << f, 0, cx, 0, f, cy, 0, 0, 1;
  projection.col(3) = -projection.leftCols<3>() * center_S;
  return projection;
}

TEST(StereoPair, FindsPointsAgain) {
  // Of other focal lengths and middles, and one higher than the other.
  const Projection left = Camera(500, 320, 240, {0, 0, 0});
  const Projection right = Camera(480, 300, 250, {0.5, -0.1, 0.02});
  const auto dut = StereoPair::Make(left, right, "cameras");
  ASSERT_TRUE(dut.ok()) << dut.status();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-10, 10), depth(1, 100);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p_S(side(random), side(random), depth(random));
    const Eigen::Vector2d a = (left * p_S.homogeneous()).hnormalized();
    const Eigen::Vector2d b = (right * p_S.homogeneous()).hnormalized();
    const auto found = dut->Triangulate(a, b);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - p_S).norm(), 1e-7);
    EXPECT_LT((*dut->ProjectLeft(p_S) - a).norm(), 1e-9);
  }
}

TEST(StereoPair, WhatIsBehindOrTooFarIsNoPoint) {
  const auto dut =
      StereoPair::Make(Camera(500, 0, 0, {0, 0, 0}), Camera(500, 0, 0, {0.5, 0, 0}), "cameras");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_FALSE(dut->ProjectLeft({0, 0, -1}));
  EXPECT_FALSE(dut->Triangulate({0, 0}, {2, 0}));     // the rays part
  EXPECT_FALSE(dut->Triangulate({0, 0}, {0, 0}));     // or are parallel
  EXPECT_FALSE(dut->Triangulate({0, 0}, {-0.9, 0}));  // 278 m
  EXPECT_TRUE(dut->Triangulate({0, 0}, {-1.1, 0}));
}

TEST(StereoPair, Refusals) {
  const Projection good = Camera(500, 0, 0, {0, 0, 0});
  const auto error = [](const Projection& left, const Projection& right) {
    const auto made = StereoPair::Make(left, right, "cameras.txt");
    EXPECT_TRUE(absl::IsInvalidArgument(made.status())) << made.status();
    return std::string(made.status().message());
  };
  EXPECT_THAT(error(good, good), HasSubstr("cameras.txt: the cameras are 0 m apart"));
  EXPECT_THAT(error(Projection::Zero(), good), HasSubstr("the first matrix"));
  EXPECT_THAT(error(good, Camera(-1, 0, 0, {1, 0, 0})), HasSubstr("the second matrix"));
}

}  // namespace
}  // namespace clearway
