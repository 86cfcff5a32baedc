#include "map/ray_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/multiversion.h"

namespace clearway {
namespace {

using Mask [[gnu::vector_size(kRayLanes * sizeof(double))]] = std::int64_t;

CLEARWAY_MULTIVERSION void Start(double resolution_m, const LaneFloats (&origin)[3],
                                 const LaneFloats (&end)[3], RayLanes& rays) {
  const double voxels_per_m = 1.0 / resolution_m;
  const auto index_of = [&](const LaneFloats& coordinate, LaneInts& index) {
    const LaneDoubles position = voxels_per_m * __builtin_convertvector(coordinate, LaneDoubles);
    index = __builtin_convertvector(position, LaneInts);
    index +=
        __builtin_convertvector(position < __builtin_convertvector(index, LaneDoubles), LaneInts);
  };
  LaneFloats difference[3];
  for (int axis = 0; axis < 3; ++axis) {
    index_of(origin[axis], rays.key[axis]);
    index_of(end[axis], rays.end[axis]);
    difference[axis] = end[axis] - origin[axis];
  }
  const LaneFloats square =
      difference[0] * difference[0] + difference[1] * difference[1] + difference[2] * difference[2];
  LaneFloats length;
  for (int lane = 0; lane < kRayLanes; ++lane) {
    length[lane] = static_cast<float>(std::sqrt(static_cast<double>(square[lane])));
  }
  rays.length_m = __builtin_convertvector(length, LaneDoubles);
  constexpr double kNever = std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis) {
    const LaneFloats direction = length > 0 ? difference[axis] / length : LaneFloats{};
    const LaneInts forward = direction > 0, backward = direction < 0;
    rays.step[axis] = backward - forward;
    const LaneDoubles slope = __builtin_convertvector(direction, LaneDoubles);
    const LaneDoubles half_step =
        __builtin_convertvector(rays.step[axis], LaneDoubles) * resolution_m * 0.5;
    const LaneDoubles border =
        (__builtin_convertvector(rays.key[axis], LaneDoubles) + 0.5) * resolution_m +
        __builtin_convertvector(__builtin_convertvector(half_step, LaneFloats), LaneDoubles);
    const Mask moves = __builtin_convertvector(rays.step[axis] != 0, Mask);
    rays.t_max[axis] = moves ? (border - __builtin_convertvector(origin[axis], LaneDoubles)) / slope
                             : kNever + LaneDoubles{};
    rays.t_delta[axis] =
        moves ? resolution_m / (slope < 0 ? -slope : slope) : kNever + LaneDoubles{};
  }
}

// The sums of a walk, one after the other, so that they round alike; only the marking is left out.
// The axes do not matter to each other: a walk makes its steps in the order of t_max.
CLEARWAY_MULTIVERSION void Skip(RayLanes& rays, const LaneDoubles& until_m, int most_steps) {
  const LaneDoubles until = until_m;
  LaneDoubles x = rays.t_max[0], y = rays.t_max[1], z = rays.t_max[2];
  const LaneDoubles dx = rays.t_delta[0], dy = rays.t_delta[1], dz = rays.t_delta[2];
  for (int step = 0; step < most_steps; ++step) {
    x = x < until ? x + dx : x;
    y = y < until ? y + dy : y;
    z = z < until ? z + dz : z;
  }
  const LaneDoubles moved[3] = {x, y, z};
  for (int axis = 0; axis < 3; ++axis) {
    const LaneDoubles steps = (moved[axis] - rays.t_max[axis]) / rays.t_delta[axis] + 0.5;
    rays.key[axis] += rays.step[axis] * __builtin_convertvector(steps, LaneInts);
    rays.t_max[axis] = moved[axis];
  }
}

}  // namespace

void StartLanes(const VoxelGrid& grid, const LaneFloats (&origin)[3], const LaneFloats (&end)[3],
                RayLanes& rays) {
  Start(grid.resolution_m(), origin, end, rays);
}

void SkipLanes(RayLanes& rays, const LaneDoubles& wanted_m) {
  // Where a ray begins on a border, rounding can put its first step a little before its origin.
  constexpr double kNowhere = -std::numeric_limits<double>::infinity();
  const LaneDoubles until_m = wanted_m > 0 ? wanted_m : kNowhere + LaneDoubles{};
  double most_steps = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const LaneDoubles steps = (until_m - rays.t_max[axis]) / rays.t_delta[axis];
    for (int lane = 0; lane < kRayLanes; ++lane) most_steps = std::max(most_steps, steps[lane]);
  }
  Skip(rays, until_m, static_cast<int>(most_steps) + 2);
}

WindowRay InWindow(const RayLanes& rays, int lane, const BitWindow& window) {
  WindowRay ray;
  for (int axis = 0; axis < 3; ++axis) {
    ray.t_max[axis] = rays.t_max[axis][lane];
    ray.t_delta[axis] = rays.t_delta[axis][lane];
    ray.stride[axis] = rays.step[axis][lane] * window.strides()[axis];
  }
  ray.length_m = rays.length_m[lane];
  ray.index = window.IndexOf({rays.key[0][lane], rays.key[1][lane], rays.key[2][lane]});
  ray.end = window.IndexOf({rays.end[0][lane], rays.end[1][lane], rays.end[2][lane]});
  return ray;
}

}  // namespace clearway
