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

}  // namespace

bool IsPassedThrough(const MovingObject& object, const Pose& T_W_O,
                     std::span<const std::uint32_t> points, const LabelledCloud& cloud,
                     const SceneParams& params) {
  const double least = 0.25 * static_cast<double>(points.size());
  return VotesOn(object.observed_box_O, object, T_W_O, cloud, params).AreAgainst(least);
}

}  // namespace clearway
