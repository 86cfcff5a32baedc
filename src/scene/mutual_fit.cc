#include "scene/mutual_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

#include "clearway/map/voxel_neighbours.h"
#include "scene/occupied_centers.h"

namespace clearway {
namespace {

// Squared, in voxels, from the point to the nearest occupied voxel: no more than of two voxels.
double SquareOff(const VoxelMap& map, const Eigen::Vector3d& p) {
  constexpr double kMost = 4;
  if (!map.grid().Addressable(p)) return kMost;
  const double voxel_m = map.grid().resolution_m();
  double least = kMost;
  for (const VoxelKey key : WithNeighbours(map.grid().KeyOf(p))) {
    if (map.State(key) != VoxelState::kOccupied) continue;
    least = std::min(least, (map.grid().CenterOf(key) - p).squaredNorm() / (voxel_m * voxel_m));
  }
  return least;
}

// Some of the occupied voxels, evenly, each of which stands for `weight` of them.
struct Sample {
  explicit Sample(const VoxelMap& map) {
    constexpr std::size_t kMost = 400;
    const std::vector<Eigen::Vector3d> all = OccupiedCenters(map);
    const std::size_t step = (all.size() + kMost - 1) / kMost;
    for (std::size_t i = 0; i < all.size(); i += step) points.push_back(all[i]);
    weight = static_cast<double>(step);
  }
  std::vector<Eigen::Vector3d> points;
  double weight;
};

class Fit {
 public:
  Fit(const VoxelMap& map_L, const VoxelMap& map_Y, const VoxelMap& around_Y)
      : map_L_(map_L), map_Y_(map_Y), around_Y_(around_Y), of_L_(map_L), of_Y_(map_Y) {
    Aabb box_L;
    for (const Eigen::Vector3d& p_L : of_L_.points) box_L.Extend(p_L);
    middle_L_ = box_L.Center();
  }

  Pose Near(Pose T_Y_L) const {
    constexpr std::array kSteps_voxels = {0.8, 0.4, 0.2};
    constexpr int kMostRounds = 6;
    double cost = Cost(T_Y_L);
    for (const double voxels : kSteps_voxels) {
      const double step_m = voxels * map_L_.grid().resolution_m();
      for (int round = 0; round < kMostRounds; ++round) {
        if (!Improve(step_m, T_Y_L, cost)) break;
      }
    }
    return T_Y_L;
  }

 private:
  // A ray that passes tells less than a hit: it may graze.
  double Cost(const Pose& T_Y_L) const {
    constexpr double kOfPassed = 0.3;
    const Pose T_L_Y = Inverse(T_Y_L);
    double of_Y = 0, of_L = 0;
    for (const Eigen::Vector3d& p_Y : of_Y_.points) of_Y += SquareOff(map_L_, T_L_Y * p_Y);
    for (const Eigen::Vector3d& p_L : of_L_.points) {
      const Eigen::Vector3d p_Y = T_Y_L * p_L;
      if (!around_Y_.grid().Addressable(p_Y)) continue;
      if (around_Y_.State(around_Y_.grid().KeyOf(p_Y)) != VoxelState::kFree) continue;
      of_L += SquareOff(map_Y_, p_Y);
    }
    return of_Y_.weight * of_Y + kOfPassed * of_L_.weight * of_L;
  }

  // Whether a step along x or y or about z, one way or the other, costs less: all that do are made.
  bool Improve(double step_m, Pose& T_Y_L, double& cost) const {
    constexpr double kMetresPerRad = 3;
    const double rad = step_m / kMetresPerRad;
    const std::array<Twist, 3> steps = {
        {{{0, 0, 0}, {step_m, 0, 0}}, {{0, 0, 0}, {0, step_m, 0}}, {{0, 0, rad}, {0, 0, 0}}}};
    bool improved = false;
    for (const Twist& step : steps) {
      for (const double way : {-1.0, 1.0}) {
        const Pose moved = Moved(T_Y_L, {way * step.angular, way * step.linear});
        const double moved_cost = Cost(moved);
        if (moved_cost >= cost) continue;
        T_Y_L = moved;
        cost = moved_cost;
        improved = true;
      }
    }
    return improved;
  }

  // By a step in Y about the middle of L.
  Pose Moved(const Pose& T_Y_L, const Twist& step_Y) const {
    const Pose to_middle{.translation = T_Y_L * middle_L_};
    return to_middle * Exp(step_Y) * Inverse(to_middle) * T_Y_L;
  }

  const VoxelMap &map_L_, &map_Y_, &around_Y_;
  Sample of_L_, of_Y_;
  Eigen::Vector3d middle_L_;
};

}  // namespace

Pose MutualFit(const VoxelMap& map_L, const VoxelMap& map_Y, const VoxelMap& around_Y,
               const Pose& T_Y_L) {
  return Fit(map_L, map_Y, around_Y).Near(T_Y_L);
}

}  // namespace clearway
