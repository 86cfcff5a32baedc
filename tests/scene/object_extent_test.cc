#include "clearway/scene/object_extent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

// What a wrong label has put beside it.
TEST(ObjectExtent, IsNotThatOfAFewVoxelsFarOff) {
  const MovingObject box = TurnedBox(0);
  const ObjectExtent before = ExtentOf(box);
  VoxelMap map_O = box.map_O;
  for (int i = 0; i < 5; ++i) map_O.Set({0, 15 + i, 0}, map_O.model().clamp_max);
  const MovingObject spoilt = WithMap(box, map_O);
  EXPECT_NEAR(spoilt.solid->box_O.Size().y(), box.solid->box_O.Size().y() + 1, 0.15);
  EXPECT_NEAR(ExtentOf(spoilt).size_m.y(), before.size_m.y(), 0.15);
}

TEST(SpanOf, LeavesOutOneOfTwoHundredAtEachEnd) {
  std::vector<double> values;
  for (int i = 399; i >= 0; --i) values.push_back(i);
  EXPECT_EQ(SpanOf(values).length, 395);  // from 2 to 397
  EXPECT_EQ(SpanOf(values).middle, 199.5);
  EXPECT_EQ(SpanOf({7, 3}).length, 4);
  EXPECT_EQ(SpanOf({7}).length, 0);
  EXPECT_EQ(SpanOf({7}).middle, 7);
}

TEST(ObjectExtent, LengthPointsForwards) {
  MovingObject object = TurnedBox(0.3);
  for (const double heading_rad : {0.3, 0.3 + std::numbers::pi, 1.5, -1.0}) {
    object.velocity_O =
        Twist{Eigen::Vector3d::Zero(), {3 * std::cos(heading_rad), 3 * std::sin(heading_rad), 0}};
    const ObjectExtent dut = ExtentOf(object);
    EXPECT_NEAR(dut.size_m.x(), 4.0, 0.3) << heading_rad;
    EXPECT_NEAR(dut.size_m.y(), 1.8, 0.3) << heading_rad;
    EXPECT_GT(std::cos(dut.yaw_rad - heading_rad), 0) << heading_rad;
  }
}

TEST(ObjectExtent, IgnoresTheDirectionOfNoise) {
  MovingObject object = TurnedBox(0.3);
  object.velocity_O = Twist{Eigen::Vector3d::Zero(), {0, 0.1, 0}};
  EXPECT_NEAR(ExtentOf(object).size_m.x(), 4.0, 0.3);
}

}  // namespace
}  // namespace clearway
