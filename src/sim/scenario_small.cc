#include "sim/meshes.h"
#include "sim/scenario_parts.h"

namespace clearway {
namespace {

World SmallWorld() {
  World world;
  world.Add(Ground(0, 0, 60));
  world.Add(StaticBox("wall", PlacedAt(0, 6.03, 1.2), {16, 0.3, 2.5}));
  world.Add(Pole("pole", -3.1, 2.9, 0.2, 2.5));
  world.Add(
      Body::Single(1, "box", Box{{1.5, 0.8, 1.0}},
                   ConstantTwist{PlacedAt(-2, 3.5, 0.47), {{0, 0, 0}, {1.5, 0, 0}}, AtSeconds(0)}));
  world.Add(Body::Single(2, "cylinder", Cylinder{0.4, 1.6},
                         Drive{.T_W_B = PlacedAt(4, -3, 0.77),
                               .start_speed_mps = 1,
                               .legs = {{FromSeconds(3), 1, 1.5}},
                               .start = AtSeconds(0)}));
  const auto wedge = Extruded({{-0.6, -0.4}, {0.6, -0.4}, {-0.6, 0.4}}, 0.8);
  world.Add(
      Body::Single(3, "wedge", TriangleMesh{wedge},
                   ConstantTwist{PlacedAt(-3, -3, 0.37), {{0, 0, 0.9}, {0, 0, 0}}, AtSeconds(0)}));
  return world;
}

}  // namespace

SimulationSpec SmallSpec() {
  SpinningLidar lidar = SpinningLidar::With16Beams();
  lidar.azimuth_steps = 256;
  lidar.lowest_rad = -0.35;
  lidar.highest_rad = 0.17;
  lidar.max_range_m = 20;
  SimulationSpec spec;
  spec.name = "small";
  spec.world = SmallWorld();
  spec.sensor = lidar;
  spec.sensor_trajectory = FixedPose{PlacedAt(0, 0, 1.23)};
  spec.frame_count = 20;
  return spec;
}

}  // namespace clearway
