#include <numbers>

#include "sim/scenario_parts.h"

namespace clearway {
namespace {

// The road runs along x, between the kerbs at y = -3.3 m and 3.3 m; traffic keeps right. The robot
// crosses it at x = 0, and the plan is made at this time.
constexpr double kPlanningS = 3;
constexpr double kNearLaneYM = -1.6;  // traffic goes along +x
constexpr double kFarLaneYM = 1.6;    // along -x

constexpr double kTowardsMinusX = std::numbers::pi;

// Passes x = 0 so long after the planning time.
Trajectory Passing(double seconds_after, double y_m, double z_m, double yaw_rad, double speed_mps) {
  return ConstantTwist{PlacedAt(0, y_m, z_m, yaw_rad),
                       {{0, 0, 0}, {speed_mps, 0, 0}},
                       AtSeconds(kPlanningS + seconds_after)};
}

// Follows the first car, slows down to let the robot cross, and speeds up again.
Trajectory Yielding() {
  return Drive{.T_W_B = PlacedAt(-46, kNearLaneYM, kCarHeightM),
               .start_speed_mps = 7,
               .legs = {{FromSeconds(3.5), 7, 0}, {FromSeconds(2), 3, 0}, {FromSeconds(3), 8, 0}},
               .start = AtSeconds(0)};
}

World CrossingWorld() {
  World world;
  world.Add(Ground(0, 0, 240));
  world.Add(StaticBox("house", PlacedAt(-16, 12.03, 3.9), {22, 6, 8}));
  world.Add(StaticBox("house", PlacedAt(15, 13.03, 2.9), {26, 8, 6}));
  world.Add(StaticBox("wall", PlacedAt(-4, -10.53, 1.2), {40, 0.4, 2.5}));
  world.Add(StaticBox("parked car", PlacedAt(9.2, 4.33, 0.7), {4.3, 1.7, 1.5}));
  world.Add(StaticBox("parked van", PlacedAt(-13.4, 4.43, 1.0), {5.1, 1.9, 2.1}));
  world.Add(StaticBox("crate", PlacedAt(3.1, -4.37, 0.4, 0.3), {1.1, 0.8, 0.9}));
  world.Add(Pole("lamp", 4.6, -4.03, 0.12, 5));
  world.Add(Pole("tree", -4.9, 4.57, 0.22, 4));

  world.Add(Car(1, Passing(1.2, kNearLaneYM, kCarHeightM, 0, 7)));
  world.Add(Van(2, Passing(2.0, kFarLaneYM, kVanHeightM, kTowardsMinusX, 5)));
  world.Add(Hatchback(3, Yielding()));
  world.Add(Car(4, Passing(5.6, kFarLaneYM, kCarHeightM, kTowardsMinusX, 6)));
  world.Add(Cyclist(5, Passing(4.4, -2.75, kCyclistHeightM, 0, 4)));
  world.Add(Pedestrian(6, Passing(2, 5.9, kPedestrianHeightM, 0, 1.3)));
  return world;
}

CrossingTask Task() {
  return {.name = "across the road",
          .planning_frame = 30,
          .start_W = {0, -4, 0},
          .goal_W = {0, 4, 0},
          .time_limit = std::chrono::seconds(12),
          .blocker = 1,
          .area_W = {{-8, -5.5, 0}, {8, 5.5, 1.2}}};
}

}  // namespace

SimulationSpec CrossingSpec() {
  SpinningLidar lidar = SpinningLidar::With64Beams();
  lidar.lowest_rad = -0.56;
  lidar.highest_rad = 0.06;
  SimulationSpec spec;
  spec.name = "crossing";
  spec.world = CrossingWorld();
  spec.sensor = lidar;
  // On a slow carrier on the near pavement: its motion closes the gaps between the beams.
  spec.sensor_trajectory =
      ConstantTwist{PlacedAt(-8.5, -7.2, 2.45), {{0, 0, 0}, {0.8, 0, 0}}, AtSeconds(0)};
  spec.frame_count = 80;
  spec.tasks = {Task()};
  return spec;
}

}  // namespace clearway
