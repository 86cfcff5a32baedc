// CARLA's frames are left-handed, ours are not: what must come out where, from CARLA's own
// formulas.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <random>

#include "io/carla_example.h"
#include "io/carla_tables.h"

namespace clearway {
namespace {

constexpr double kWritten_m = 2e-4;  // PLY files have four decimals

Pose Ours(const CarlaPlace& place) {
  return FromCarla({.location_m = {place.x, place.y, place.z},
                    .roll_deg = place.roll,
                    .pitch_deg = place.pitch,
                    .yaw_deg = place.yaw});
}

TEST(CarlaHandedness, IsTheMirroredMatrix) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-180, 180), metres(-50, 50);
  const Eigen::Vector4d mirror(1, -1, 1, 1);
  for (int i = 0; i < 200; ++i) {
    const CarlaPlace place{metres(random), metres(random), metres(random),
                           angle(random),  angle(random),  angle(random)};
    const Pose dut = Ours(place);
    const Eigen::Matrix4d expected = mirror.asDiagonal() * place.Matrix() * mirror.asDiagonal();
    EXPECT_TRUE(dut.rotation.toRotationMatrix().isApprox(expected.topLeftCorner<3, 3>(), 1e-12));
    EXPECT_TRUE(dut.translation.isApprox(expected.topRightCorner<3, 1>(), 1e-12));
    EXPECT_NEAR(dut.rotation.toRotationMatrix().determinant(), 1, 1e-12);
  }
}

TEST(CarlaHandedness, TheThreeRules) {
  const Eigen::Vector3d nose(1, 0, 0), left(0, 1, 0);
  EXPECT_LT((Ours({.yaw = 30}) * nose).y(), -0.4);   // to the right
  EXPECT_GT((Ours({.pitch = 20}) * nose).z(), 0.3);  // up
  EXPECT_GT((Ours({.roll = 10}) * left).z(), 0.1);   // the right side is down
}

// What stands still, seen by a sensor that goes, turns and tilts, stays where it is.
TEST_F(Carla, TheWorldStandsStill) {
  const std::vector<CarlaHit> world = {
      {{12, 4, 0}}, {{3, -7, 1}}, {{-5, 2, 3}}, {{8, 8, 0.5}, 31, 14}};
  const CarlaPlace sensors[] = {{1, 2, 2, 0, 0, 0}, {3, -1, 2.2, 5, -12, 75}};
  std::string table = kCarlaSensor;
  for (int k = 0; k < 2; ++k) {
    folder_.Write(absl::StrFormat("%06d.ply", k), CarlaScan(sensors[k], world));
    absl::StrAppend(&table, k, ",", 1 + k, ",", sensors[k].Fields(), "\n");
  }
  folder_.Write("carla_sensor.csv", table);
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (int k = 0; k < 2; ++k) {
    const auto frame = dut->frames.read(k);
    ASSERT_TRUE(frame.ok()) << frame.status();
    ASSERT_EQ(frame->points_S.size(), world.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
      const Eigen::Vector3d p_W = frame->T_W_S * frame->points_S[i].cast<double>();
      EXPECT_LT((p_W - Mirrored(world[i].p)).norm(), kWritten_m) << k << " " << i;
    }
  }
}

// A car that banks, climbs and turns right: its motion carries the points of one scan to those of
// the next.
TEST_F(Carla, MotionsCarryThePointsOfActors) {
  const CarlaPlace cars[] = {{10, 3, 0.5, 1, 2, 10}, {11.5, 3.6, 0.7, 4, -3, 32}};
  const CarlaPlace sensors[] = {{0, 0, 2, 0, 1, 5}, {1, 0.2, 2, 2, 0, 12}};
  const Eigen::Vector3d corners[] = {{2, 0.9, 0}, {2, -0.9, 0}, {-2, 0.9, 1.4}, {-2, -0.9, 1.4}};
  std::string table = kCarlaSensor, actors = kCarlaActors;
  for (int k = 0; k < 2; ++k) {
    std::vector<CarlaHit> hits;
    for (const Eigen::Vector3d& p : corners) {
      hits.push_back({(cars[k].Matrix() * p.homogeneous()).head<3>(), 31, 14});
    }
    folder_.Write(absl::StrFormat("%06d.ply", k), CarlaScan(sensors[k], hits));
    absl::StrAppend(&table, k, ",", 1 + 0.1 * k, ",", sensors[k].Fields(), "\n");
    absl::StrAppend(&actors, k, ",31,car,", cars[k].Fields(), "\n");
  }
  folder_.Write("carla_sensor.csv", table);
  folder_.Write("carla_actors.csv", actors);
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto first = dut->frames.read(0), second = dut->frames.read(1);
  ASSERT_TRUE(first.ok() && second.ok()) << first.status() << second.status();
  ASSERT_EQ(second->motions.size(), 1u);
  const Pose& H_W = second->motions[0].H_W;
  for (std::size_t i = 0; i < std::size(corners); ++i) {
    const Eigen::Vector3d before_W = first->T_W_S * first->points_S[i].cast<double>();
    const Eigen::Vector3d after_W = second->T_W_S * second->points_S[i].cast<double>();
    EXPECT_LT((H_W * before_W - after_W).norm(), 2 * kWritten_m) << i;
  }
  EXPECT_LT(Log(H_W).angular.z(), -0.3);  // clockwise from above
}

}  // namespace
}  // namespace clearway
