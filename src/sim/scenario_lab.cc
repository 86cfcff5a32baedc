#include "sim/meshes.h"
#include "sim/scenario_parts.h"

namespace clearway {
namespace {

constexpr double kFloorZM = -0.025;  // in the middle of a 5 cm voxel

void AddRoom(World& world) {
  world.Add(Ground(0, 0, 12, kFloorZM));
  world.Add(StaticBox("ceiling", PlacedAt(0, 0, 2.92), {8.6, 6.6, 0.2}));
  world.Add(StaticBox("wall", PlacedAt(4.12, 0, 1.4), {0.2, 6.6, 3}));
  world.Add(StaticBox("wall", PlacedAt(-4.12, 0, 1.4), {0.2, 6.6, 3}));
  world.Add(StaticBox("wall", PlacedAt(0, 3.12, 1.4), {8.6, 0.2, 3}));
  world.Add(StaticBox("wall", PlacedAt(0, -3.12, 1.4), {8.6, 0.2, 3}));
  world.Add(StaticBox("table", PlacedAt(0.8, 0.9, 0.72), {1.2, 0.7, 0.06}));
  world.Add(StaticBox("table leg", PlacedAt(0.8, 0.9, 0.33), {0.3, 0.3, 0.71}));
  world.Add(StaticBox("shelf", PlacedAt(3.6, 1.6, 0.98), {0.7, 1.3, 2.0}));
  world.Add(
      Body::Single(kStaticLabel, "column", Cylinder{0.2, 3}, FixedPose{PlacedAt(2.6, -1.7, 1.4)}));
}

// A cart that drives, stops, turns on the spot, stops and drives on.
Trajectory CartTrajectory() {
  WaypointPath path;
  const auto add = [&](double seconds, double x_m, double y_m, double yaw_rad) {
    path.points.push_back({AtSeconds(seconds), PlacedAt(x_m, y_m, 0.31, yaw_rad)});
  };
  add(0, -1.2, -2.2, 0);
  add(2.5, 0.9, -2.2, 0);
  add(3.5, 0.9, -2.2, 0);
  add(4.7, 0.9, -2.2, 1.571);
  add(5.2, 0.9, -2.2, 1.571);
  add(7.5, 0.9, -0.6, 1.571);
  return path;
}

void AddMovers(World& world) {
  world.Add(Body::Single(1, "swinging box", Box{{0.4, 0.4, 0.5}},
                         Pendulum{PlacedAt(0.2, -0.9, 2.8), 1.35, 0.55, FromSeconds(2.6), Time()}));
  world.Add(
      Body::Single(2, "turning box", Box{{0.6, 0.3, 0.4}},
                   ConstantTwist{PlacedAt(0.8, 0.9, 0.98), {{0, 0, 0.8}, {0, 0, 0}}, Time()}));
  world.Add(
      Body::Single(3, "swinging cube", Box{{0.32, 0.32, 0.32}},
                   Pendulum{PlacedAt(1.7, 0.1, 2.8, 1.571), 1.1, 0.5, FromSeconds(2.1), Time()}));
  const auto angle_iron =
      Extruded({{0, 0}, {0, 0.3}, {-0.3, 0.3}, {-0.3, -0.3}, {0.3, -0.3}, {0.3, 0}}, 0.3);
  world.Add(
      Body::Single(4, "tumbling angle", TriangleMesh{angle_iron},
                   ConstantTwist{PlacedAt(-0.5, 1.4, 1.6), {{0.3, 0.5, 0.4}, {0, 0, 0}}, Time()}));
  world.Add(Body::Single(5, "cart", Box{{0.5, 0.4, 0.6}}, CartTrajectory()));
}

// Held by hand: to and fro, looking into the room.
Trajectory CameraTrajectory() {
  WaypointPath path;
  const auto add = [&](double seconds, const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
    path.points.push_back({AtSeconds(seconds), LookingAt(eye, target)});
  };
  add(0, {-3.3, -1.4, 1.5}, {0.8, -0.4, 1.0});
  add(2, {-3.1, -0.5, 1.6}, {0.8, 0.1, 1.1});
  add(4, {-3.2, 0.6, 1.5}, {0.8, 0.1, 0.9});
  add(6, {-3.0, 1.1, 1.4}, {0.8, -0.3, 1.0});
  add(8, {-3.2, 0.2, 1.6}, {0.8, -0.2, 1.1});
  return path;
}

}  // namespace

SimulationSpec LabSpec() {
  SimulationSpec spec;
  spec.name = "lab";
  AddRoom(spec.world);
  AddMovers(spec.world);
  DepthCamera camera;
  camera.max_range_m = 8.5;
  spec.sensor = camera;
  spec.sensor_trajectory = CameraTrajectory();
  spec.frame_count = 120;
  spec.period = FromSeconds(1.0 / 15);
  spec.resolution_m = 0.05;
  return spec;
}

}  // namespace clearway
