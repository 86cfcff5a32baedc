#include "map/ray_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/multiversion.h"

namespace clearway {
namespace {

double Least(const LaneDoubles& values) {
  double least = values[0];
  for (int lane = 1; lane < kLanes; ++lane) least = std::min(least, values[lane]);
  return least;
}

CLEARWAY_MULTIVERSION void Start(double resolution_m, const RaySegments& segments, RayLanes& rays) {
  const auto& [origin, end] = segments;
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
  for (int lane = 0; lane < kLanes; ++lane) {
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
    const LaneLongs moves = __builtin_convertvector(rays.step[axis] != 0, LaneLongs);
    rays.t_max[axis] = moves ? (border - __builtin_convertvector(origin[axis], LaneDoubles)) / slope
                             : kNever + LaneDoubles{};
    rays.t_delta[axis] =
        moves ? resolution_m / (slope < 0 ? -slope : slope) : kNever + LaneDoubles{};
  }
}

// The sums of a walk, one after the other, so that they round alike; only the marking is left out.
// The axes do not matter to each other: a walk makes its steps in the order of t_max.
CLEARWAY_MULTIVERSION void Skip(RayBatch& rays, int axis, const BatchDoubles& until_m) {
  BatchDoubles t;
  // Steps that all lanes make, and that one of them may.
  LaneDoubles least = LaneDoubles{} + std::numeric_limits<double>::max(), most{};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    t[i] = rays[i].t_max[axis];
    const LaneDoubles steps = (until_m[i] - t[i]) / rays[i].t_delta[axis];
    least = steps < least ? steps : least;
    most = steps > most ? steps : most;
  }
  const auto in_all = static_cast<int>(std::max(Least(least), 0.0));
  const auto in_one = static_cast<int>(-Least(-most)) + 2;
  for (int step = 0; step < in_all; ++step) {
    for (std::size_t i = 0; i < rays.size(); ++i) t[i] += rays[i].t_delta[axis];
  }
  for (int step = in_all; step < in_one; ++step) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      t[i] = t[i] < until_m[i] ? t[i] + rays[i].t_delta[axis] : t[i];
    }
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RayLanes& ray = rays[i];
    const LaneDoubles steps = (t[i] - ray.t_max[axis]) / ray.t_delta[axis] + 0.5;
    ray.key[axis] += ray.step[axis] * __builtin_convertvector(steps, LaneInts);
    ray.t_max[axis] = t[i];
  }
}

CLEARWAY_MULTIVERSION void Place(const RayLanes& rays, const BitWindow& window,
                                 WindowRays& in_window) {
  const VoxelKey low = window.low();
  const auto index_of = [&](const LaneInts(&key)[3], LaneInts& index) {
    index = key[0] - low.x + window.strides()[1] * (key[1] - low.y) +
            window.strides()[2] * (key[2] - low.z);
  };
  for (int axis = 0; axis < 3; ++axis) {
    in_window.t_max[axis] = rays.t_max[axis];
    in_window.t_delta[axis] = rays.t_delta[axis];
    in_window.stride[axis] = rays.step[axis] * window.strides()[axis];
  }
  in_window.length_m = rays.length_m;
  index_of(rays.key, in_window.index);
  index_of(rays.end, in_window.end);
}

}  // namespace

void RayEights::Clear() {
  eights_.clear();
  size_ = 0;
}

void RayEights::Finish() {
  if (size_ == 0) return;
  const Eigen::Vector3f origin = SegmentIn(eights_[0], 0).origin;
  while (size_ % kLanes != 0) Add({origin, origin});
}

void StartLanes(const VoxelGrid& grid, const RaySegments& segments, RayLanes& rays) {
  Start(grid.resolution_m(), segments, rays);
}

void SkipLanes(RayBatch& rays, const BatchDoubles& wanted_m) {
  // Where a ray begins on a border, rounding can put its first step a little before its origin.
  constexpr double kNowhere = -std::numeric_limits<double>::infinity();
  BatchDoubles until_m;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    until_m[i] = wanted_m[i] > 0 ? wanted_m[i] : kNowhere + LaneDoubles{};
  }
  for (int axis = 0; axis < 3; ++axis) Skip(rays, axis, until_m);
}

void PlaceInWindow(const RayLanes& rays, const BitWindow& window, WindowRays& in_window) {
  Place(rays, window, in_window);
}

}  // namespace clearway
