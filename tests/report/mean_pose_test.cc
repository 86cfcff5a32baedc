#include "clearway/report/mean_pose.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace clearway {
namespace {

TEST(MeanPose, OfPosesAroundOneIsThatOne) {
  testing_support::Random random(2);
  const Pose middle = random.AnyPose(5);
  MeanPose dut;
  EXPECT_TRUE(dut.Empty());
  for (const double sign : {1.0, -1.0}) {
    dut.Add(middle * Exp({Eigen::Vector3d(0, sign * 0.2, 0), Eigen::Vector3d(sign, 0, 0)}));
  }
  EXPECT_FALSE(dut.Empty());
  EXPECT_LT(dut.Value().rotation.angularDistance(middle.rotation), 1e-9);
  // Screws that turn are not straight, but these two are alike.
  EXPECT_LT((dut.Value().translation - middle.translation).norm(), 0.2);
}

}  // namespace
}  // namespace clearway
