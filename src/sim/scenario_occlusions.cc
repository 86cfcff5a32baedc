#include <array>
#include <numbers>

#include "sim/behind_walls.h"

namespace clearway {
namespace {

constexpr std::array<Kind, 3> kVehicles = {
    {{Car, kCarHeightM}, {Hatchback, kCarHeightM}, {Van, kVanHeightM}}};
constexpr Kind kCyclist = {Cyclist, kCyclistHeightM};
constexpr Kind kPedestrian = {Pedestrian, kPedestrianHeightM};

class Occlusions {
 public:
  explicit Occlusions(std::uint64_t seed) : random_(seed, kStream) {}

  World Make() {
    world_.Add(Ground(0, 0, 240));
    world_.Add(StaticBox("houses", PlacedAt(0, 23.03, 3.9), {110, 6, 8}));
    AddWalls();
    AddTraffic(10.3, true);
    AddTraffic(13.6, false);
    AddAlone(kCyclist, 8.6, 3, 6);
    AddAlone(kCyclist, 16.2, 3, 6);
    for (const double y_m : {6.1, 6.9, 7.7, 17.2, 18.0}) AddAlone(kPedestrian, y_m, 1.0, 1.8);
    return std::move(world_);
  }

 private:
  static constexpr std::uint64_t kStream = std::uint64_t{1} << 61;

  double Between(double low, double high) { return clearway::Between(random_, low, high); }

  // One to each side, and one in the middle.
  void AddWalls() {
    for (const double x_m : {-8.0, 0.0, 8.0}) {
      const double width_m = Between(1.0, 5.0);
      world_.Add(WallBefore(x_m + Between(-1.5, 1.5), width_m));
    }
  }

  Drive DriveFrom(const Pose& T_W_B, double speed_mps) {
    return UnevenDrive(random_, T_W_B, speed_mps, 0.8, 1.2);
  }

  // Vehicles of all kinds behind each other, all at the same speed.
  void AddTraffic(double y_m, bool along_x) {
    const double sign = along_x ? 1 : -1, yaw_rad = along_x ? 0 : std::numbers::pi;
    const Drive leader = DriveFrom(PlacedAt(0, y_m, 0, yaw_rad), Between(5, 11));
    double x_m = Between(-25, 10);
    for (int i = 0; i < 7; ++i) {
      const Kind& kind = kVehicles[static_cast<std::size_t>(Between(0, kVehicles.size()))];
      Drive drive = leader;
      drive.T_W_B = PlacedAt(sign * x_m, y_m, kind.height_m, yaw_rad);
      world_.Add(kind.make(next_id_++, drive));
      x_m -= Between(9, 30);
    }
  }

  // One that has that lane to itself.
  void AddAlone(const Kind& kind, double y_m, double slowest_mps, double fastest_mps) {
    const bool along_x = Heads(random_);
    const double speed_mps = Between(slowest_mps, fastest_mps);
    // In sight for most of the time.
    const double x_m = (along_x ? -1 : 1) * Between(0.3, 0.8) * speed_mps * 20;
    world_.Add(kind.make(
        next_id_++,
        DriveFrom(PlacedAt(x_m, y_m, kind.height_m, along_x ? 0 : std::numbers::pi), speed_mps)));
  }

  Random random_;
  World world_;
  ObjectId next_id_ = 1;
};

}  // namespace

SimulationSpec OcclusionsSpec(std::uint64_t seed) {
  return BehindWalls("occlusions", Occlusions(seed).Make());
}

}  // namespace clearway
