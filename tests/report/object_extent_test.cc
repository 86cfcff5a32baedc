#include "clearway/report/object_extent.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/polygon.h"
#include "report/test_scene.h"

namespace clearway {
namespace {

// A long box along `yaw_rad` in O.
MovingObject TurnedBox(double yaw_rad) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  VoxelMap map_O(0.1);
  for (double x = -2; x <= 2; x += 0.05) {
    for (double y = -0.9; y <= 0.9; y += 0.05) {
      for (const double z : {-0.7, 0.7}) {
        map_O.Set(map_O.grid().KeyOf(R * Eigen::Vector3d(x, y, z)), map_O.model().clamp_max);
      }
    }
  }
  MovingObject object;
  object.id = 1;
  object.history = {{Time{}, Pose{}}};
  return WithMap(std::move(object), std::move(map_O));
}

TEST(ObjectExtent, Empty) {
  MovingObject object;
  object.history = {{Time{}, Pose{}}};
  const MovingObject empty = WithMap(std::move(object), VoxelMap(0.1));
  const ObjectExtent dut = ExtentOf(empty);
  EXPECT_EQ(dut.size_m, Eigen::Vector3d::Zero());
}

TEST(ObjectExtent, IsTheBoxWhateverItsDirection) {
  for (double yaw_rad = -1.4; yaw_rad < 1.5; yaw_rad += 0.35) {
    const ObjectExtent dut = ExtentOf(TurnedBox(yaw_rad));
    EXPECT_NEAR(dut.size_m.x(), 4.0, 0.3) << yaw_rad;  // voxels add up to their diagonal
    EXPECT_NEAR(dut.size_m.y(), 1.8, 0.3) << yaw_rad;
    EXPECT_NEAR(dut.size_m.z(), 1.4, 0.2) << yaw_rad;
    EXPECT_LT(std::abs(std::sin(dut.yaw_rad - yaw_rad)), 0.05) << yaw_rad;
  }
}

TEST(ObjectExtent, LengthLiesAlongTheMotion) {
  MovingObject object = TurnedBox(0.3);
  const double sideways = 0.3 + 1.5;
  object.velocity_O = Twist{{}, {3 * std::cos(sideways), 3 * std::sin(sideways), 0}};
  object.velocity_O->angular.setZero();
  const ObjectExtent dut = ExtentOf(object);
  EXPECT_NEAR(dut.size_m.x(), 1.8, 0.3);
  EXPECT_NEAR(dut.size_m.y(), 4.0, 0.3);
  EXPECT_GT(std::cos(dut.yaw_rad - sideways), 0.9);
}

TEST(ObjectExtent, IgnoresTheDirectionOfNoise) {
  MovingObject object = TurnedBox(0.3);
  object.velocity_O = Twist{Eigen::Vector3d::Zero(), {0, 0.1, 0}};
  EXPECT_NEAR(ExtentOf(object).size_m.x(), 4.0, 0.3);
}

TEST(ConvexOutline, Empty) { EXPECT_TRUE(report::ConvexOutline({}).empty()); }

TEST(ConvexOutline, DropsInnerPointsAndTurnsLeft) {
  const report::Polygon dut =
      report::ConvexOutline({{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}});
  ASSERT_EQ(dut.size(), 4u);
  double area2 = 0;
  for (std::size_t i = 0; i < dut.size(); ++i) {
    const Eigen::Vector2d a = dut[i], b = dut[(i + 1) % dut.size()];
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_DOUBLE_EQ(area2, 8);
}

}  // namespace
}  // namespace clearway
