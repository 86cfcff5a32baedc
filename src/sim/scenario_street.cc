#include <array>
#include <numbers>

#include "sim/scenario_parts.h"

namespace clearway {
namespace {

constexpr double kSensorHeightM = 1.93;
constexpr double kOncomingM = 3.4;  // lateral, to the left of the sensor's lane
constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kHalfTurn = std::numbers::pi;

// The sensor's drive: along street A, left into street B, a stop at a pedestrian crossing, and
// round a bend to the right into street C. 480 m in 55.4 s.
Drive EgoDrive(double z_m) {
  return {.T_W_B = PlacedAt(0, 0, z_m),
          .start_speed_mps = 10,
          .legs = {{FromSeconds(12), 10, 0},
                   {FromSeconds(2.5), 6, 0},
                   {FromSeconds(3), 6, kQuarterTurn},
                   {FromSeconds(4), 12, 0},
                   {FromSeconds(9), 12, 0},
                   {FromSeconds(4), 0, 0},
                   {FromSeconds(3), 0, 0},
                   {FromSeconds(5), 10, 0},
                   {FromSeconds(5), 10, -kQuarterTurn / 2},
                   {FromSeconds(7.9), 10, 0}},
          .start = AtSeconds(0)};
}
constexpr double kEnterStreetBS = 17.5;
constexpr double kEnterStreetCS = 47.5;

// A street's frame: the sensor's lane at z = 0, x along the drive.
Pose StreetA() { return Pose(); }
Pose StreetB() { return PoseAt(EgoDrive(0), AtSeconds(kEnterStreetBS)); }
Pose StreetC() { return PoseAt(EgoDrive(0), AtSeconds(kEnterStreetCS)); }

// Goes straight along a street and is at x_m at that time.
Trajectory Along(const Pose& street, double seconds, double x_m, double lateral_m, double z_m,
                 double speed_mps, double yaw_rad = 0) {
  return ConstantTwist{street * PlacedAt(x_m, lateral_m, z_m, yaw_rad),
                       {{0, 0, 0}, {speed_mps, 0, 0}},
                       AtSeconds(seconds)};
}

// Both rows of houses along a street from one x to another, with gaps, and poles on the right.
void AddHouses(World& world, const Pose& street, double from_m, double to_m) {
  constexpr std::array<double, 5> kHeights = {6.2, 9.1, 7.3, 11.4, 5.2};
  std::size_t i = 0;
  for (double x = from_m; x + 16 <= to_m; x += 19.5, ++i) {
    const double height_m = kHeights[i % kHeights.size()];
    const double depth_m = 6 + kHeights[(i + 2) % kHeights.size()] / 3;
    world.Add(StaticBox("house", street * PlacedAt(x + 8, 10.53 + depth_m / 2, height_m / 2 - 0.2),
                        {16, depth_m, height_m}));
    world.Add(StaticBox("house",
                        street * PlacedAt(x + 8.7, -8.23 - depth_m / 2, height_m / 2 - 0.2),
                        {15, depth_m, height_m}));
    const Eigen::Vector3d pole = street * Eigen::Vector3d(x + 17.6, -6.63, 0);
    world.Add(Pole("lamp", pole.x(), pole.y(), 0.11, 6));
  }
}

void AddParkedCars(World& world, const Pose& street, std::initializer_list<double> xs_m) {
  for (const double x : xs_m) {
    world.Add(StaticBox("parked car", street * PlacedAt(x, -4.23, 0.72), {4.3, 1.7, 1.5}));
  }
}

void AddStaticWorld(World& world) {
  world.Add(Ground(120, 130, 1000));
  AddHouses(world, StreetA(), -60, 135);
  AddHouses(world, StreetA(), 176, 280);
  AddHouses(world, StreetB(), 8, 196);
  AddHouses(world, StreetB(), -110, -30);
  AddHouses(world, StreetC(), 26, 140);
  AddParkedCars(world, StreetA(), {12, 31, 52, 88, 101});
  AddParkedCars(world, StreetB(), {30, 36.5, 80, 110});
  AddParkedCars(world, StreetC(), {60, 66, 90});
}

// Stays behind the sensor on street B, and stops and bends as it does.
Trajectory Follower() {
  return Drive{.T_W_B = StreetB() * PlacedAt(-242, 0, kCarHeightM),
               .start_speed_mps = 12,
               .legs = {{FromSeconds(31.4), 12, 0},
                        {FromSeconds(4), 0, 0},
                        {FromSeconds(3.2), 0, 0},
                        {FromSeconds(5), 9, 0},
                        {FromSeconds(12.7 / 9), 9, 0},
                        {FromSeconds(50.0 / 9), 9, -kQuarterTurn / 2}},
               .start = AtSeconds(0)};
}

// Comes down street C and round the bend into B.
Trajectory OncomingRoundTheBend() {
  const double radius_m = 50 / (kQuarterTurn / 2) + kOncomingM;
  const double bend_s = radius_m * kQuarterTurn / 2 / 9;
  return Drive{
      .T_W_B = StreetC() * PlacedAt(25 + 9 * 50, kOncomingM, kCarHeightM, kHalfTurn),
      .start_speed_mps = 9,
      .legs = {{FromSeconds(50 + 25.0 / 9), 9, 0}, {FromSeconds(bend_s), 9, kQuarterTurn / 2}},
      .start = AtSeconds(0)};
}

// Stands at the kerb of street C and pulls out in front of the sensor.
Trajectory PullingOut() {
  return Drive{
      .T_W_B = StreetC() * PlacedAt(38, -3.0, kCarHeightM),
      .start_speed_mps = 0,
      .legs = {{FromSeconds(2), 4, 0.35}, {FromSeconds(2), 6, -0.35}, {FromSeconds(3), 8, 0}},
      .start = AtSeconds(45)};
}

// Waits at one side of the pedestrian crossing on street B, and goes over to the other.
Trajectory Crossing(double x_m, double from_lateral_m, double to_lateral_m, double start_s,
                    double end_s) {
  const auto point = [&](double seconds, double lateral_m) {
    return WaypointPath::Point{AtSeconds(seconds),
                               StreetB() * PlacedAt(x_m, lateral_m, kPedestrianHeightM)};
  };
  return WaypointPath{{point(start_s, from_lateral_m), point(end_s, to_lateral_m)}};
}

void AddMovers(World& world) {
  const Pose A = StreetA();
  const Pose B = StreetB();
  world.Add(Car(1, Along(A, 4, 40, kOncomingM, kCarHeightM, 9, kHalfTurn)));
  world.Add(Hatchback(2, Along(A, 0, 25, 0, kCarHeightM, 10)));
  world.Add(Cyclist(3, Along(A, 8, 80, -2.4, kCyclistHeightM, 4)));
  world.Add(Pedestrian(4, Along(A, 6, 62, -5.6, kPedestrianHeightM, 1.3, kHalfTurn)));
  world.Add(Truck(5, Along(A, 10.5, 105, kOncomingM, kTruckHeightM, 7, kHalfTurn)));
  world.Add(Car(6, Along(B, 9.5, -11.5, kOncomingM, kCarHeightM, 8, kHalfTurn)));
  world.Add(Car(7, Along(B, 22, 42, kOncomingM, kCarHeightM, 10, kHalfTurn)));
  world.Add(Van(8, Along(B, 29, 126, kOncomingM, kVanHeightM, 8, kHalfTurn)));
  world.Add(Car(9, Follower()));
  world.Add(Pedestrian(10, Crossing(174.5, -7.2, 7.0, 33, 42.3)));
  world.Add(Pedestrian(11, Crossing(176.0, 7.0, -7.2, 32.4, 41.2)));
  world.Add(Cyclist(12, Along(B, 27, 102, -5.7, kCyclistHeightM, 4)));
  world.Add(Hatchback(13, OncomingRoundTheBend()));
  world.Add(Car(14, PullingOut()));
}

}  // namespace

SimulationSpec StreetSpec() {
  SimulationSpec spec;
  spec.name = "street";
  AddStaticWorld(spec.world);
  AddMovers(spec.world);
  spec.sensor = SpinningLidar::With64Beams();
  spec.sensor_trajectory = EgoDrive(kSensorHeightM);
  spec.frame_count = 555;
  return spec;
}

}  // namespace clearway
