// Rays eight at a time, a lane each, up to where a walk begins.
#pragma once

#include <cstdint>

#include "clearway/map/ray.h"
#include "map/bit_window.h"
#include "map/window_walk.h"

namespace clearway {

inline constexpr int kRayLanes = 8;

// GCC's and Clang's vectors: operators work value by value, and comparisons give all ones or 0.
using LaneFloats [[gnu::vector_size(kRayLanes * sizeof(float))]] = float;
using LaneDoubles [[gnu::vector_size(kRayLanes * sizeof(double))]] = double;
using LaneInts [[gnu::vector_size(kRayLanes * sizeof(std::int32_t))]] = std::int32_t;

// What RayStart is for one ray, bit for bit.
struct RayLanes {
  LaneInts key[3], end[3];  // voxels: x, y, z
  LaneInts step[3];
  LaneDoubles t_max[3], t_delta[3];
  LaneDoubles length_m;
};

// StartRay for eight rays, from origin[x, y, z] to end[x, y, z].
void StartLanes(const VoxelGrid& grid, const LaneFloats (&origin)[3], const LaneFloats (&end)[3],
                RayLanes& rays);

// Moves each ray to where it has made all the steps that a walk makes before until_m metres from
// its origin; not positive: the ray stays. until_m must lie before the ray's end voxel and its
// length.
void SkipLanes(RayLanes& rays, const LaneDoubles& until_m);

// One of them, in the terms of a window.
WindowRay InWindow(const RayLanes& rays, int lane, const BitWindow& window);

}  // namespace clearway
