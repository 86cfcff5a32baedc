#include <numbers>
#include <utility>

#include "sim/behind_walls.h"

namespace clearway {
namespace {

constexpr double kHalfRoad_m = 9;  // along which walls stand

// People who look alike, one close behind the other: whoever comes out from behind a wall could be
// the one before or behind.
class Queues {
 public:
  explicit Queues(std::uint64_t seed) : random_(seed, kStream) {}

  World Make() {
    world_.Add(Ground(0, 0, 240));
    world_.Add(StaticBox("houses", PlacedAt(0, 23.03, 3.9), {110, 6, 8}));
    AddWalls();
    for (const double y_m : {5.6, 6.8, 8.0}) {
      AddQueue({Pedestrian, kPedestrianHeightM}, 0.65, y_m, 1, 2);
    }
    AddQueue({Cyclist, kCyclistHeightM}, 1.9, 9.4, 2.5, 4);
    return std::move(world_);
  }

 private:
  static constexpr std::uint64_t kStream = std::uint64_t{3} << 60;

  double Between(double low, double high) { return clearway::Between(random_, low, high); }

  // Between some, a slit through which one is seen at a time, and hardly for a frame.
  void AddWalls() {
    for (double x_m = -kHalfRoad_m; x_m < kHalfRoad_m;) {
      const double width_m = Between(1.5, 7);
      world_.Add(WallBefore(x_m + width_m / 2, width_m));
      x_m += width_m + (Heads(random_) ? Between(0.05, 0.3) : Between(1.5, 4));
    }
  }

  // All speed up at once, wherever they are, so that their distances stay: at least `nearest_m`
  // from one's middle to the next one's.
  void AddQueue(const Kind& kind, double nearest_m, double y_m, double slowest_mps,
                double fastest_mps) {
    const double sign = Heads(random_) ? 1 : -1, yaw_rad = sign > 0 ? 0 : std::numbers::pi;
    const double speed_mps = Between(slowest_mps, fastest_mps);
    const Drive leader =
        UnevenDrive(random_, PlacedAt(0, y_m, kind.height_m, yaw_rad), speed_mps, 0.75, 1.3);
    double x_m = Between(-kHalfRoad_m, kHalfRoad_m / 2);
    const int count = static_cast<int>(Between(3, 7));
    for (int i = 0; i < count; ++i) {
      Drive drive = leader;
      drive.T_W_B.translation.x() = sign * x_m;
      world_.Add(kind.make(next_id_++, drive));
      x_m -= nearest_m * Between(1, 2);
    }
  }

  Random random_;
  World world_;
  ObjectId next_id_ = 1;
};

}  // namespace

SimulationSpec QueuesSpec(std::uint64_t seed) { return BehindWalls("queues", Queues(seed).Make()); }

}  // namespace clearway
