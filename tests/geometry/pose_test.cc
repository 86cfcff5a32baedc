#include "clearway/geometry/pose.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

void ExpectNear(const Pose& a, const Pose& b, double tolerance) {
  EXPECT_LT((a.translation - b.translation).norm(), tolerance);
  EXPECT_LT((a.rotation.toRotationMatrix() - b.rotation.toRotationMatrix()).norm(), tolerance);
}

TEST(Pose, EmptyIsTheIdentity) {
  EXPECT_EQ(Pose() * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3));
}

TEST(Pose, ComposesLikeMatrices) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose T_A_B = random.AnyPose(10), T_B_C = random.AnyPose(10);
    const Eigen::Vector3d p_C = random.Vector(10);
    EXPECT_LT((T_A_B * T_B_C * p_C - T_A_B * (T_B_C * p_C)).norm(), 1e-12);
  }
}

TEST(Pose, TransformsManyPointsAsItDoesOne) {
  Random random(7);
  for (const std::size_t count : {0, 1, 7, 8, 100}) {
    const Pose T_A_B = random.AnyPose(100);
    std::vector<Eigen::Vector3f> points_B;
    for (std::size_t i = 0; i < count; ++i) points_B.push_back(random.Vector(50).cast<float>());
    std::vector<Eigen::Vector3d> points_A(count);
    TransformAll(T_A_B, points_B, points_A.data());
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(points_A[i], T_A_B * points_B[i].cast<double>());
    }
  }
}

TEST(Pose, InverseUndoes) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose T_A_B = random.AnyPose(10);
    ExpectNear(Inverse(T_A_B) * T_A_B, Pose(), 1e-12);
  }
}

TEST(Pose, StaysRigidOverThousandsOfProducts) {
  Random random(3);
  const Pose step = random.AnyPose(0.1);
  Pose pose;
  for (int i = 0; i < 100'000; ++i) pose = pose * step;
  EXPECT_NEAR(pose.rotation.norm(), 1.0, 1e-14);
}

TEST(Pose, ExpAndLogAreInverse) {
  Random random(4);
  for (double angle : {0.0, 1e-9, 1e-5, 0.9999e-4, 1.0001e-4, 0.01, 1.0, 3.0, 3.14159}) {
    const Twist twist{angle * random.UnitVector(), random.Vector(5)};
    const Twist back = Log(Exp(twist));
    EXPECT_LT((back.angular - twist.angular).norm(), 1e-9) << angle;
    EXPECT_LT((back.linear - twist.linear).norm(), 1e-8) << angle;
  }
}

// The exponential as its defining limit: many small steps.
TEST(Pose, ExpIsTheLimitOfSmallSteps) {
  Random random(5);
  const Twist twist{1.3 * random.UnitVector(), random.Vector(2)};
  constexpr int kSteps = 1 << 20;
  Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
  const Eigen::Vector3d w = twist.angular / kSteps;
  step.topLeftCorner<3, 3>() +=
      (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
  step.topRightCorner<3, 1>() = twist.linear / kSteps;
  for (int doubling = 0; doubling < 20; ++doubling) step = step * step;
  const Pose exact = Exp(twist);
  EXPECT_LT((step.topLeftCorner<3, 3>() - exact.rotation.toRotationMatrix()).norm(), 1e-5);
  EXPECT_LT((step.topRightCorner<3, 1>() - exact.translation).norm(), 1e-5);
}

TEST(Pose, LogTakesTheShorterWay) {
  const Pose turn{
      Eigen::Quaterniond(Eigen::AngleAxisd(1.5 * std::numbers::pi, Eigen::Vector3d::UnitZ())),
      Eigen::Vector3d::Zero()};
  EXPECT_NEAR(Log(turn).angular.z(), -0.5 * std::numbers::pi, 1e-12);
}

TEST(Pose, InterpolatesAndExtrapolatesAScrew) {
  Random random(6);
  const Pose T_W_A = random.AnyPose(5);
  const Twist velocity{0.4 * random.UnitVector(), random.Vector(2)};
  const Pose T_W_B = T_W_A * Exp(velocity);
  ExpectNear(Interpolate(T_W_A, T_W_B, 0), T_W_A, 1e-12);
  ExpectNear(Interpolate(T_W_A, T_W_B, 1), T_W_B, 1e-12);
  ExpectNear(Interpolate(T_W_A, T_W_B, 0.3), T_W_A * Exp(0.3 * velocity), 1e-12);
  ExpectNear(Interpolate(T_W_A, T_W_B, 3), T_W_A * Exp(3 * velocity), 1e-12);
}

}  // namespace
}  // namespace clearway
