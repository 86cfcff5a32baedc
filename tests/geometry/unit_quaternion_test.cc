#include "clearway/geometry/unit_quaternion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace clearway {
namespace {

constexpr double kHalf = 0.70710678118654752440;

TEST(UnitQuaternion, RoundedComponentsPassAndOthersDoNot) {
  for (const double c : {kHalf, 0.7071068, 0.70711, 0.7071, 0.707, 0.71}) {
    EXPECT_TRUE(IsNearlyUnit({c, 0, 0, c})) << c;
    EXPECT_TRUE(IsNearlyUnit({-c, 0, c, 0})) << c;
  }
  EXPECT_TRUE(IsNearlyUnit({1.0099, 0, 0, 0}));
  EXPECT_TRUE(IsNearlyUnit({0.9901, 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({1.0101, 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({0.9899, 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({0, 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({std::numeric_limits<double>::quiet_NaN(), 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({std::numeric_limits<double>::infinity(), 0, 0, 0}));
  EXPECT_FALSE(IsNearlyUnit({1e300, 1e300, 0, 0}));
}

TEST(UnitQuaternion, TheMessageNamesTheLengthAndTheLimit) {
  EXPECT_EQ(NotUnitText({1.0101, 0, 0, 0}),
            "has length 1.0101; a unit quaternion is needed, to within 0.01");
}

TEST(UnitQuaternion, NormalizedHasLengthOneAndTheSameDirection) {
  const Eigen::Quaterniond rounded(0.71, 0, 0, 0.7);
  const Eigen::Quaterniond dut = Normalized(rounded);
  EXPECT_NEAR(dut.norm(), 1, 1e-15);
  EXPECT_NEAR(dut.w() / dut.z(), 0.71 / 0.7, 1e-15);
}

TEST(UnitQuaternion, WhatRoundingAloneKeepsFromLengthOneStaysBitForBit) {
  for (int i = 1; i <= 100; ++i) {
    const Eigen::Quaterniond q = Eigen::Quaterniond(i, 100 - i, 3, 7.0 / i).normalized() *
                                 Eigen::Quaterniond(0.6, 0.8, 0, 0);
    EXPECT_EQ(Normalized(q).coeffs(), q.coeffs());
  }
}

TEST(UnitQuaternion, RenormalizesAListOnlyIfThatChangesOne) {
  const Pose exact{Eigen::Quaterniond(kHalf, 0, 0, kHalf), {1, 2, 3}};
  const Pose rounded{Eigen::Quaterniond(0.707, 0, 0, 0.707), {1, 2, 3}};
  EXPECT_FALSE(Renormalized(std::vector{exact, exact}).has_value());
  const auto dut = Renormalized(std::vector{exact, rounded});
  ASSERT_TRUE(dut.has_value());
  EXPECT_EQ((*dut)[0], exact);
  EXPECT_NEAR((*dut)[1].rotation.norm(), 1, 1e-15);
  EXPECT_EQ((*dut)[1].translation, rounded.translation);
}

}  // namespace
}  // namespace clearway
