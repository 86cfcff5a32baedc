// Things that are not rigid, or whose parts move against each other.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "sim/scenario_parts.h"

namespace clearway {
namespace {

constexpr double kSensorHeightM = 1.93;
constexpr std::size_t kFrames = 120;
constexpr double kLastS = 0.1 * kFrames;
constexpr double kPi = std::numbers::pi;

// Along poses so close in time that the screws between them are as good as the way itself.
WaypointPath Sampled(const std::function<Pose(double seconds)>& T_W_B) {
  constexpr int kPerSecond = 50;
  WaypointPath path;
  for (int i = 0; i <= static_cast<int>(kLastS * kPerSecond); ++i) {
    const double seconds = static_cast<double>(i) / kPerSecond;
    path.points.push_back({AtSeconds(seconds), T_W_B(seconds)});
  }
  return path;
}

// The trailer's hitch, x forward, behind a tractor: its axle rolls and does not slip. From straight
// behind it at 0 s.
WaypointPath HitchBehind(const Trajectory& tractor, double hitch_x_m, double hitch_to_axle_m) {
  constexpr int kPerSecond = 1000;
  const auto hitch_at = [&](int i) {
    const Pose T_W_B = PoseAt(tractor, AtSeconds(static_cast<double>(i) / kPerSecond));
    return Eigen::Vector3d(T_W_B * Eigen::Vector3d(hitch_x_m, 0, 0));
  };
  WaypointPath path;
  const Eigen::Vector3d forward_W =
      PoseAt(tractor, AtSeconds(0)).rotation * Eigen::Vector3d::UnitX();
  double yaw_rad = std::atan2(forward_W.y(), forward_W.x());
  Eigen::Vector3d hitch_W = hitch_at(0);
  for (int i = 0; i <= static_cast<int>(kLastS * kPerSecond); ++i) {
    const Eigen::Vector3d next_W = hitch_at(i), step_W = next_W - hitch_W;
    yaw_rad += (std::cos(yaw_rad) * step_W.y() - std::sin(yaw_rad) * step_W.x()) / hitch_to_axle_m;
    hitch_W = next_W;
    if (i % 20 != 0) continue;
    path.points.push_back({AtSeconds(static_cast<double>(i) / kPerSecond),
                           PlacedAt(hitch_W.x(), hitch_W.y(), hitch_W.z(), yaw_rad)});
  }
  return path;
}

WaypointPath Mounted(WaypointPath path, const Pose& T_B_M) {
  for (WaypointPath::Point& point : path.points) point.T_W_B = point.T_W_B * T_B_M;
  return path;
}

// Comes along x, turns to the left before the sensor, and drives away; 7 m long trailer.
void AddTruck(World& world, ObjectId tractor, ObjectId trailer) {
  constexpr double kHitchXM = -1.6, kHitchToAxleM = 5.2;
  const Drive drive{.T_W_B = PlacedAt(-22, 7, 0.9),
                    .start_speed_mps = 5,
                    .legs = {{FromSeconds(3.2), 5, 0},
                             {FromSeconds(3), 4, kPi / 2},
                             {FromSeconds(2), 5, 0},
                             {FromSeconds(3), 5, -kPi / 3}},
                    .start = AtSeconds(0)};
  world.Add({tractor,
             "tractor",
             {{Box{{2.2, 2.4, 2.7}}, Pose::Translation(1.65, 0, 0.62)},
              {Box{{5.5, 1.0, 0.5}}, Pose::Translation(0, 0, -0.45)}},
             drive});
  world.Add({trailer,
             "trailer",
             {{Box{{7.0, 2.4, 2.2}}, Pose::Translation(0, 0, 1.1)}},
             Mounted(HitchBehind(drive, kHitchXM, kHitchToAxleM), Pose::Translation(-2.6, 0, 0.1)),
             tractor});
}

// From one end to the other in the middle, along z.
Pose Between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), to - from),
          0.5 * (from + to)};
}

constexpr double kThighM = 0.43, kShankM = 0.43;

struct Leg {
  Eigen::Vector3d hip_B, knee_B, foot_B;
};

// A pedalling leg; the knee is where both bones reach, and before the hip.
Leg LegAt(double crank_rad, double side_m) {
  constexpr double kCrankM = 0.17;
  const Eigen::Vector3d hip_B(-0.12, side_m, 0.08);
  const Eigen::Vector3d foot_B(0.05 + kCrankM * std::cos(crank_rad), side_m,
                               -0.55 - kCrankM * std::sin(crank_rad));
  const Eigen::Vector3d down_B = foot_B - hip_B;
  const double length_m = down_B.norm();
  const double along_m =
      (length_m * length_m + kThighM * kThighM - kShankM * kShankM) / (2 * length_m);
  const double beside_m = std::sqrt(std::max(0.0, kThighM * kThighM - along_m * along_m));
  const Eigen::Vector3d forward_B = Eigen::Vector3d::UnitY().cross(-down_B / length_m);
  return {hip_B, hip_B + along_m / length_m * down_B - beside_m * forward_B, foot_B};
}

// Ids of the rider, then of left thigh and shank, then of the right ones.
void AddCyclist(World& world, ObjectId rider, const Drive& drive) {
  constexpr double kCadenceHz = 1.1;
  world.Add({rider,
             "cyclist",
             {{Box{{1.7, 0.10, 0.75}}, Pose::Translation(0, 0, -0.51)},
              {Capsule{0.20, 0.50}, Pose::Translation(-0.1, 0, 0.42)}},
             drive});
  ObjectId id = rider + 1;
  for (const double side : {1.0, -1.0}) {
    const auto leg_at = [side](double seconds) {
      return LegAt(2 * kPi * kCadenceHz * seconds + (side > 0 ? 0 : kPi), 0.13 * side);
    };
    const auto thigh_at = [drive, leg_at](double seconds) {
      const Leg leg = leg_at(seconds);
      return PoseAt(drive, AtSeconds(seconds)) * Between(leg.hip_B, leg.knee_B);
    };
    const auto shank_at = [drive, leg_at](double seconds) {
      const Leg leg = leg_at(seconds);
      return PoseAt(drive, AtSeconds(seconds)) * Between(leg.knee_B, leg.foot_B);
    };
    world.Add({id++, "thigh", {{Capsule{0.08, kThighM - 0.16}, {}}}, Sampled(thigh_at), rider});
    world.Add({id++, "shank", {{Capsule{0.06, kShankM - 0.12}, {}}}, Sampled(shank_at), rider});
  }
}

// Stands on its tracks and swings its boom to and fro.
void AddExcavator(World& world, ObjectId base, ObjectId boom) {
  const Pose T_W_B = PlacedAt(9, -11, 0.55, 0.4);
  world.Add({base, "excavator", {{Box{{3.6, 2.8, 1.1}}, {}}}, FixedPose{T_W_B}});
  const auto boom_at = [T_W_B](double seconds) {
    const double yaw_rad = 1.1 * std::sin(2 * kPi * seconds / 9);
    return T_W_B * PlacedAt(0, 0, 0.6, yaw_rad);
  };
  world.Add({boom,
             "boom",
             {{Box{{3.0, 2.4, 1.4}}, Pose::Translation(-0.3, 0, 0.75)},
              {Box{{4.5, 0.5, 0.5}}, Pose::Translation(3.3, 0, 1.2)}},
             Sampled(boom_at),
             base});
}

void AddStaticWorld(World& world) {
  world.Add(Ground(0, 0, 160));
  world.Add(StaticBox("wall", PlacedAt(0, 48.03, 2.2), {90, 0.4, 4.6}));
  world.Add(StaticBox("shed", PlacedAt(-28, -18, 1.6), {9, 6, 3.4}));
  world.Add(Pole("lamp", 14, 1.5, 0.12, 5));
}

}  // namespace

SimulationSpec ArticulatedSpec() {
  SimulationSpec spec;
  spec.name = "articulated";
  AddStaticWorld(spec.world);
  AddTruck(spec.world, 1, 2);
  AddCyclist(spec.world, 3,
             {.T_W_B = PlacedAt(-21, 4.2, kCyclistHeightM),
              .start_speed_mps = 4,
              .legs = {{FromSeconds(12), 4, 0}},
              .start = AtSeconds(0)});
  AddCyclist(spec.world, 8,
             {.T_W_B = PlacedAt(17, -5, kCyclistHeightM, kPi),
              .start_speed_mps = 3,
              .legs = {{FromSeconds(5), 3, 0}, {FromSeconds(4), 3, kPi / 3}},
              .start = AtSeconds(0)});
  AddExcavator(spec.world, 13, 14);
  spec.world.Add(Car(
      15, ConstantTwist{PlacedAt(30, 20, kCarHeightM, kPi), {{0, 0, 0}, {6, 0, 0}}, AtSeconds(0)}));
  SpinningLidar lidar = SpinningLidar::With64Beams();
  lidar.highest_rad = 0.10;
  spec.sensor = lidar;
  spec.sensor_trajectory = FixedPose{PlacedAt(0, 0, kSensorHeightM, kPi / 2)};
  spec.frame_count = kFrames;
  return spec;
}

}  // namespace clearway
