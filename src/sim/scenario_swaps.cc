#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "sim/behind_walls.h"

namespace clearway {
namespace {

// As vehicles of scenario_parts.h stand: that far above the ground's frame.
constexpr double kBodyworkAboveM = 0.15;

Body Bus(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "bus", Box{{10.5, 2.5, 2.9}}, std::move(trajectory));
}

// A car half a metre higher.
Body Minibus(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "minibus", Box{{4.6, 1.9, 1.8}}, std::move(trajectory));
}

Body Minivan(ObjectId id, Trajectory trajectory) {
  return {id,
          "minivan",
          {{Box{{4.6, 1.85, 0.9}}, Pose::Translation(0, 0, -0.425)},
           {Box{{3.4, 1.75, 0.85}}, Pose::Translation(-0.5, 0, 0.45)}},
          std::move(trajectory)};
}

Body Motorcyclist(ObjectId id, Trajectory trajectory) {
  return {id,
          "motorcyclist",
          {{Box{{1.9, 0.6, 1.1}}, Pose::Translation(0, 0, -0.25)},
           {Capsule{0.28, 0.5}, Pose::Translation(-0.2, 0, 0.3)}},
          std::move(trajectory)};
}

Body Scooter(ObjectId id, Trajectory trajectory) {
  return {id,
          "scooter",
          {{Box{{1.4, 0.3, 0.4}}, Pose::Translation(0.2, 0, -0.7)},
           {Box{{0.1, 0.5, 1.2}}, Pose::Translation(0.85, 0, -0.3)},
           {Cylinder{0.3, 1.6}, Pose::Translation(-0.1, 0, 0.1)}},
          std::move(trajectory)};
}

Body Child(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "child", Cylinder{0.25, 1.15}, std::move(trajectory));
}

Body Trolley(ObjectId id, Trajectory trajectory) {
  return {id,
          "trolley",
          {{Box{{1.2, 0.6, 0.6}}, Pose::Translation(0, 0, -0.25)},
           {Box{{0.1, 0.6, 0.5}}, Pose::Translation(-0.55, 0, 0.3)}},
          std::move(trajectory)};
}

Body Crate(ObjectId id, Trajectory trajectory) {
  return Body::Single(id, "crate", Box{{1.2, 0.8, 1.1}}, std::move(trajectory));
}

constexpr Kind kCar = {Car, kCarHeightM}, kHatchback = {Hatchback, kCarHeightM};
constexpr Kind kVan = {Van, kVanHeightM}, kTruck = {Truck, kTruckHeightM};
constexpr Kind kBus = {Bus, kBodyworkAboveM + 1.45}, kMinibus = {Minibus, kBodyworkAboveM + 0.9};
constexpr Kind kMinivan = {Minivan, kBodyworkAboveM + 0.875};
constexpr Kind kCyclist = {Cyclist, kCyclistHeightM}, kMotorcyclist = {Motorcyclist, 0.95};
constexpr Kind kPedestrian = {Pedestrian, kPedestrianHeightM}, kScooter = {Scooter, 0.95};
constexpr Kind kChild = {Child, 0.6}, kTrolley = {Trolley, 0.6}, kCrate = {Crate, 0.6};

// Of like place and way, of another shape.
constexpr std::array<std::pair<Kind, Kind>, 10> kPairs = {{{kCar, kBus},
                                                           {kCar, kVan},
                                                           {kCar, kMinivan},
                                                           {kHatchback, kMinibus},
                                                           {kVan, kTruck},
                                                           {kCyclist, kMotorcyclist},
                                                           {kPedestrian, kCyclist},
                                                           {kPedestrian, kScooter},
                                                           {kPedestrian, kChild},
                                                           {kTrolley, kCrate}}};

// Before the LiDAR one goes behind a wall and stays there, and another one comes out when and where
// it would have; behind the LiDAR the same one comes out. All but the walls are so much farther
// off.
class Swaps {
 public:
  Swaps(std::uint64_t seed, double farther_m) : random_(seed, kStream), farther_m_(farther_m) {
    const std::uint64_t way = (seed + 2 * kPairs.size() - 1) % (2 * kPairs.size());
    std::tie(lost_, young_) = kPairs[way / 2];
    if (way % 2 == 1) std::swap(lost_, young_);
  }

  World Make() {
    world_.Add(Ground(0, 0, 240));
    AddSide(0, lost_, young_);
    AddSide(std::numbers::pi, lost_, lost_);
    return std::move(world_);
  }

 private:
  static constexpr std::uint64_t kStream = std::uint64_t{5} << 60;
  static constexpr double kHides_s = 6;  // about then
  static constexpr double kLasts_s = 20;

  double Between(double low, double high) { return clearway::Between(random_, low, high); }

  // What lies before a sensor that is turned by yaw_rad.
  void AddSide(double yaw_rad, const Kind& first, const Kind& second) {
    const Pose T_W_V = PlacedAt(0, 0, 0, yaw_rad);
    const double wide_m = std::max(SizeOf(first).y(), SizeOf(second).y());
    const double y_m = (wide_m > 1.5 ? 8 : 6.5) + farther_m_ + Between(0, 3);
    Stand(T_W_V, StaticBox("houses", PlacedAt(0, y_m + 8, 3.9), {110, 6, 8}));
    // Along the way: both are hidden whole side by side, half a metre apart.
    const double hidden_m = SizeOf(first).x() + SizeOf(second).x() + 1;
    Stand(T_W_V, WallBefore(0, WallFor(hidden_m, y_m - wide_m / 2)));
    AddWay(T_W_V, y_m, hidden_m, first, second);
  }

  void Stand(const Pose& T_W_V, Body body) {
    auto& fixed = std::get<FixedPose>(body.trajectory);
    fixed.T_W_B = T_W_V * fixed.T_W_B;
    world_.Add(std::move(body));
  }

  // Those who go past, one way or the other.
  void AddWay(const Pose& T_W_V, double y_m, double hidden_m, const Kind& first,
              const Kind& second) {
    const double sign = Heads(random_) ? 1 : -1;
    const double apart_m = hidden_m / 2;
    const double speed_mps = apart_m / Between(0.8, 1.5);
    const auto at = [&](const Kind& kind, double along_m) {
      const double turned_rad = sign > 0 ? 0 : std::numbers::pi;
      return T_W_V * PlacedAt(sign * along_m, y_m, kind.height_m, turned_rad);
    };
    const double stop_m = -hidden_m / 2 + 0.25 + SizeOf(first).x() / 2, start_m = stop_m + apart_m;
    const double start_s = kHides_s + apart_m / speed_mps;
    const Pose begin = at(first, stop_m - kHides_s * speed_mps);
    const Pose end = at(second, start_m + (kLasts_s - start_s) * speed_mps);
    if (first.make == second.make) {
      world_.Add(first.make(next_id_++, Straight(0, begin, kLasts_s, end)));
      return;
    }
    world_.Add(first.make(next_id_++, Straight(0, begin, kHides_s, at(first, stop_m))));
    world_.Add(second.make(next_id_++, Straight(start_s, at(second, start_m), kLasts_s, end)));
  }

  static Eigen::Vector3d SizeOf(const Kind& kind) {
    return kind.make(1, FixedPose{}).BoxB().Size();
  }
  static WaypointPath Straight(double from_s, const Pose& from, double until_s, const Pose& until) {
    return {{{AtSeconds(from_s), from}, {AtSeconds(until_s), until}}};
  }

  Random random_;
  double farther_m_;
  Kind lost_, young_;
  World world_;
  ObjectId next_id_ = 1;
};

SimulationSpec Spec(std::string name, std::uint64_t seed, double farther_m) {
  SimulationSpec spec = BehindWalls(std::move(name), Swaps(seed, farther_m).Make());
  spec.frame_count = 110;
  return spec;
}

}  // namespace

SimulationSpec SwapsSpec(std::uint64_t seed) { return Spec("swaps", seed, 0); }

SimulationSpec FarSwapsSpec(std::uint64_t seed) { return Spec("far_swaps", seed, 20); }

}  // namespace clearway
