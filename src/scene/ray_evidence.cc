#include "scene/ray_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/rays_near.h"

namespace clearway {
namespace {

// How many rays speak for something, and against it.
struct Votes {
  int in_favour = 0, against = 0;

  // So many at least must be against it. Of an object that is hidden but for an edge, a few rays
  // always pass that edge.
  bool AreAgainst(double least) const {
    constexpr double kFewRays = 5, kMost = 0.8;
    return against >= std::max(kFewRays, least) && against >= kMost * (in_favour + against);
  }
};

// What the part of a ray finds in a map.
enum class Finds { kNothing, kSomethingAtItsEnd, kSomethingBefore };

Finds WhatFinds(const VoxelMap& map_O, const Eigen::Vector3f& from_O, const Eigen::Vector3f& to_O) {
  const auto is_occupied = [&](const VoxelKey& key) {
    return map_O.State(key) == VoxelState::kOccupied;
  };
  const VoxelGrid& grid = map_O.grid();
  const Eigen::Vector3d end_O = to_O.cast<double>();
  if (is_occupied(grid.KeyOf(end_O))) return Finds::kSomethingAtItsEnd;
  std::optional<VoxelKey> last;
  WalkRay(grid, from_O, to_O, [&](const VoxelKey& key) {
    if (is_occupied(key)) last = key;
  });
  if (!last) return Finds::kNothing;
  const double near_m = 1.5 * grid.resolution_m();
  return (grid.CenterOf(*last) - end_O).norm() < near_m ? Finds::kSomethingAtItsEnd
                                                        : Finds::kSomethingBefore;
}

// Of the occupied voxels in the box: rays that meet them end on them, or go on.
Votes VotesOn(const Aabb& box_O, const MovingObject& object, const Pose& T_W_O,
              const LabelledCloud& cloud, const SceneParams& params) {
  const ClippedRays rays = RaysWithin(box_O, T_W_O, cloud, params);
  const std::vector<ObjectId> ids = object.Ids();
  Votes votes;
  for (std::size_t i = 0; i < rays.ends_O.size(); ++i) {
    const Finds found = WhatFinds(object.map_O, rays.origins_O[i], rays.ends_O[i]);
    if (found == Finds::kNothing) continue;
    const ObjectId label = cloud.labels[rays.of[i]];
    const bool is_another = label > kStaticLabel && std::ranges::find(ids, label) == ids.end();
    const bool ends_there = rays.kinds[i] == RayEnd::kBlock && found == Finds::kSomethingAtItsEnd;
    ++(ends_there && !is_another ? votes.in_favour : votes.against);
  }
  return votes;
}

// How many of the object's own points hide occupied voxels in the box, so far behind them or more.
int HidingPoints(const Aabb& box_O, double apart_m, const MovingObject& object, const Pose& T_W_O,
                 std::span<const std::uint32_t> points, const LabelledCloud& cloud) {
  const Pose T_O_W = Inverse(T_W_O);
  int hiding = 0;
  for (const std::uint32_t i : points) {
    const Eigen::Vector3f& origin_W = cloud.origins_W[cloud.origins_W.size() == 1 ? 0 : i];
    const Eigen::Vector3d origin_O = T_O_W * origin_W.cast<double>();
    const Eigen::Vector3d ray_O = T_O_W * cloud.ends_W[i].cast<double>() - origin_O;
    const double reach_m = std::max(ray_O.norm(), 1e-3);
    const auto [begin, end] = Clip(box_O, origin_O, ray_O,
                                   {1 + apart_m / reach_m, 1 + 2 * box_O.Size().norm() / reach_m});
    if (begin > end) continue;
    hiding += WhatFinds(object.map_O, (origin_O + begin * ray_O).cast<float>(),
                        (origin_O + end * ray_O).cast<float>()) != Finds::kNothing;
  }
  return hiding;
}

}  // namespace

bool IsPassedThrough(const MovingObject& object, const Pose& T_W_O,
                     std::span<const std::uint32_t> points, const LabelledCloud& cloud,
                     const SceneParams& params) {
  const double least = 0.25 * static_cast<double>(points.size());
  return VotesOn(object.observed_box_O, object, T_W_O, cloud, params).AreAgainst(least);
}

bool IsSmeared(const MovingObject& object, const Pose& T_W_O, const Eigen::Vector3d& growth_O,
               std::span<const std::uint32_t> points, const LabelledCloud& cloud,
               const SceneParams& params) {
  constexpr double kLeast_m = 1, kManyRays = 10;
  constexpr double kMostInAFrame_m = 3;  // that a wrong motion adds
  int axis = 0;
  growth_O.cwiseAbs().maxCoeff(&axis);
  const Pose T_O_W = Inverse(T_W_O);
  std::vector<double> along_m;
  for (const std::uint32_t i : points) {
    along_m.push_back((T_O_W * cloud.ends_W[i].cast<double>())[axis]);
  }
  std::ranges::sort(along_m);
  const std::size_t strays = along_m.size() / 20;
  const double least_m = along_m[strays], most_m = along_m[along_m.size() - 1 - strays];
  // Labels that bleed, and what swings, let a model grow a little.
  if (std::abs(growth_O[axis]) < 0.1 * (most_m - least_m)) return false;

  const double apart_m = 2 * object.map_O.grid().resolution_m();
  Aabb behind_O = object.observed_box_O;
  if (growth_O[axis] > 0) {
    behind_O.max[axis] = least_m - apart_m;
  } else {
    behind_O.min[axis] = most_m + apart_m;
  }
  const double behind_m = behind_O.max[axis] - behind_O.min[axis], seen_m = most_m - least_m;
  if (behind_m < std::max(kLeast_m, seen_m)) return false;
  Votes votes = VotesOn(behind_O, object, T_W_O, cloud, params);
  const auto size = static_cast<double>(points.size());
  // The longer the smear, the less of it rays from afar or along it meet.
  const bool is_long = behind_m >= 2 * seen_m;
  if (votes.AreAgainst(is_long ? 0.05 * size : std::max(kManyRays, 0.3 * size))) return true;
  // One end of a long object may hide the other.
  if (std::abs(growth_O[axis]) > kMostInAFrame_m) return false;
  votes.against += HidingPoints(behind_O, apart_m, object, T_W_O, points, cloud);
  // Labels that bleed leave background behind an object.
  return votes.AreAgainst(std::max(kManyRays, 0.5 * size));
}

}  // namespace clearway
