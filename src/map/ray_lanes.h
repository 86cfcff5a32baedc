// Rays eight at a time, a lane each, up to where a walk begins.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/lanes.h"
#include "clearway/map/ray.h"
#include "map/bit_window.h"
#include "map/window_walk.h"

namespace clearway {

// Eight rays, from origin[x, y, z] to end[x, y, z]. One that ends where it begins goes nowhere.
struct RaySegments {
  LaneFloats origin[3] = {}, end[3] = {};
};

// One of them.
struct RaySegment {
  Eigen::Vector3f origin, end;
};
inline RaySegment SegmentIn(const RaySegments& segments, int lane) {
  const auto& [origin, end] = segments;
  return {{origin[0][lane], origin[1][lane], origin[2][lane]},
          {end[0][lane], end[1][lane], end[2][lane]}};
}
inline void Put(const RaySegment& segment, int lane, RaySegments& segments) {
  for (int axis = 0; axis < 3; ++axis) {
    segments.origin[axis][lane] = segment.origin[axis];
    segments.end[axis][lane] = segment.end[axis];
  }
}

// Rays by eights, in the order in which they come. Keeps its memory when cleared.
class RayEights {
 public:
  void Clear();
  void Add(const RaySegment& ray) {
    const auto lane = static_cast<int>(size_++ % kLanes);
    if (lane == 0) eights_.emplace_back();
    Put(ray, lane, eights_.back());
  }
  // Once, after the last ray.
  void Finish();

  // Once finished. Some may be rays that go nowhere.
  std::span<const RaySegments> eights() const { return eights_; }
  // Calls visit(RaySegment) for each of them.
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const RaySegments& eight : eights_) {
      for (int lane = 0; lane < kLanes; ++lane) visit(SegmentIn(eight, lane));
    }
  }

 private:
  std::vector<RaySegments> eights_;
  std::size_t size_ = 0;
};

// What RayStart is for one ray, bit for bit.
struct RayLanes {
  LaneInts key[3], end[3];  // voxels: x, y, z
  LaneInts step[3];
  LaneDoubles t_max[3], t_delta[3];
  LaneDoubles length_m;
};

// StartRay for eight rays.
void StartLanes(const VoxelGrid& grid, const RaySegments& segments, RayLanes& rays);

// So many that the sums of some hide the latency of others'.
inline constexpr std::size_t kBatch = 4;
using RayBatch = std::array<RayLanes, kBatch>;
using BatchDoubles = LaneDoubles[kBatch];

// Moves each ray to where it has made all the steps that a walk makes before until_m[i][lane]
// metres from its origin; not positive: the ray stays. until_m must lie before the ray's end voxel
// and its length.
void SkipLanes(RayBatch& rays, const BatchDoubles& until_m);

// In the terms of a window.
void PlaceInWindow(const RayLanes& rays, const BitWindow& window, WindowRays& in_window);

}  // namespace clearway
