#include "sim/behind_walls.h"

#include <numbers>
#include <utility>

namespace clearway {
namespace {

// The sensor stands at y = 0; the roads are beyond the walls.
constexpr double kWallsYM = 4.5, kWallsThickM = 0.3;
constexpr double kSensorHeightM = 1.93;
constexpr double kLasts_s = 20;
constexpr std::size_t kFrames = 200;  // at 10 Hz

}  // namespace

double Between(Random& random, double low, double high) {
  return low + (high - low) * random.Uniform();
}

bool Heads(Random& random) { return random.Uniform() < 0.5; }

Body WallBefore(double x_m, double width_m) {
  return StaticBox("wall", PlacedAt(x_m, kWallsYM, 1.45), {width_m, kWallsThickM, 3.0});
}

// By its far edges.
double WallFor(double hidden_m, double y_m) {
  return hidden_m * (kWallsYM + kWallsThickM / 2) / y_m;
}

Drive UnevenDrive(Random& random, const Pose& T_W_B, double speed_mps, double slowest,
                  double fastest) {
  Drive drive{.T_W_B = T_W_B, .start_speed_mps = speed_mps, .legs = {}, .start = AtSeconds(0)};
  for (double seconds = 0; seconds < kLasts_s;) {
    const double lasts_s = Between(random, 2, 5);
    const double end_mps = speed_mps * Between(random, slowest, fastest);
    drive.legs.push_back({FromSeconds(lasts_s), end_mps, 0});
    seconds += lasts_s;
  }
  return drive;
}

SimulationSpec BehindWalls(std::string name, World world) {
  SpinningLidar lidar = SpinningLidar::With64Beams();
  lidar.lowest_rad = -0.4;
  lidar.highest_rad = 0.06;
  SimulationSpec spec;
  spec.name = std::move(name);
  spec.world = std::move(world);
  spec.sensor = lidar;
  spec.sensor_trajectory = FixedPose{PlacedAt(0, 0, kSensorHeightM, std::numbers::pi / 2)};
  spec.frame_count = kFrames;
  return spec;
}

}  // namespace clearway
