#include "clearway/sim/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

double Elevation(const Eigen::Vector3d& direction) { return std::asin(direction.z()); }

TEST(SensorTest, LidarHasARayPerBeamAndAzimuth) {
  SpinningLidar dut;
  dut.beams = 5;
  dut.azimuth_steps = 8;
  const auto rays = RayDirections(dut);
  ASSERT_EQ(rays.size(), 40u);
  for (const Eigen::Vector3d& ray : rays) EXPECT_NEAR(ray.norm(), 1, 1e-15);
}

TEST(SensorTest, LidarPresetsHaveTheirFieldsOfView) {
  const auto expect_view = [](const SpinningLidar& dut, int beams, double low, double high) {
    EXPECT_EQ(dut.beams, beams);
    const auto rays = RayDirections(dut);
    EXPECT_NEAR(Elevation(rays[0]), low * kRadPerDeg, 1e-12);
    EXPECT_NEAR(Elevation(rays[beams - 1]), high * kRadPerDeg, 1e-12);
  };
  expect_view(SpinningLidar::With16Beams(), 16, -15, 15);
  expect_view(SpinningLidar::With32Beams(), 32, -30.67, 10.67);
  expect_view(SpinningLidar::With64Beams(), 64, -24.8, 2);
}

TEST(SensorTest, LidarGoesOnceRoundFromBehind) {
  SpinningLidar dut;
  dut.beams = 1;
  dut.lowest_rad = 0;
  dut.azimuth_steps = 4;
  const auto rays = RayDirections(dut);
  EXPECT_LT((rays[0] + Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((rays[1] + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((rays[2] - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((rays[3] - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(SensorTest, CameraLooksAlongZWithItsFieldOfView) {
  DepthCamera dut;
  dut.width_px = 64;
  dut.height_px = 48;
  const auto rays = RayDirections(dut);
  ASSERT_EQ(rays.size(), 64u * 48u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& ray : rays) sum += ray;
  EXPECT_LT((sum.normalized() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  // Pixel centres lie half a pixel inside the view's edge.
  const Eigen::Vector3d& left = rays[24 * 64];
  EXPECT_NEAR(left.x() / left.z(), -std::tan(dut.horizontal_view_rad / 2) * 63 / 64, 1e-12);
  EXPECT_LT(rays[0].x(), 0);  // the first pixel is the upper left one; x right, y down
  EXPECT_LT(rays[0].y(), 0);
}

TEST(SensorTest, RangesAreTheSensors) {
  SpinningLidar lidar;
  lidar.min_range_m = 0.3;
  lidar.max_range_m = 33;
  EXPECT_EQ(MinRangeM(lidar), 0.3);
  EXPECT_EQ(MaxRangeM(lidar), 33);
  EXPECT_EQ(MaxRangeM(DepthCamera{}), 6);
}

}  // namespace
}  // namespace clearway
