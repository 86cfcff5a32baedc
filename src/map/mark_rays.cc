#include "map/mark_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "map/marked_cones.h"
#include "map/window_walk.h"

namespace clearway {
namespace {

constexpr std::size_t kWalkedTogether = 256;  // eights of rays

// Narrow cones skip more, but it takes time to look at each. This is flat around the best.
int ConesAcross(std::size_t rays) {
  constexpr double kRays = 8;  // in a narrow cone
  constexpr int kMultiple = 1 << MarkedCones::kLevels;
  const double across = std::sqrt(static_cast<double>(rays) / kRays);
  return kMultiple * std::clamp(static_cast<int>(across / kMultiple), 1, 128 / kMultiple);
}

class Marker {
 public:
  Marker(const VoxelGrid& grid, const RayRounds& rays, bool one_origin, BitWindow& window)
      : grid_(grid), rays_(rays), window_(window) {
    const auto [origin, end] = SegmentIn(rays.round(0)[0], 0);
    axis_ = MainAxis(end - origin);
    if (!one_origin) return;
    cones_.emplace(grid, origin.cast<double>(), axis_, end[axis_] < origin[axis_],
                   ConesAcross(rays.size()));
  }

  void Walk(std::size_t round) {
    if (cones_) cones_->NextRound();
    const std::span<const RaySegments> rays = rays_.round(round);
    for (std::size_t i = 0; i < rays.size(); i += kBatch) {
      Prepare(rays.subspan(i, std::min(kBatch, rays.size() - i)), round > 0);
      if (ready_.size() >= kWalkedTogether) WalkReady();
    }
    WalkReady();
  }

 private:
  // At most kBatch times eight.
  void Prepare(std::span<const RaySegments> segments, bool skip_marked) {
    RayBatch started;
    for (std::size_t i = 0; i < kBatch; ++i) {
      StartLanes(grid_, i < segments.size() ? segments[i] : RaySegments{}, started[i]);
    }
    if (skip_marked && cones_) SkipMarked(segments, started);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      PlaceInWindow(started[i], window_, ready_.emplace_back());
    }
  }

  // Past what is marked already, but not to the ends.
  void SkipMarked(std::span<const RaySegments> segments, RayBatch& started) {
    BatchDoubles until_m{};
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const auto& [origin, end] = segments[i];
      const LaneFloats direction[3] = {end[0] - origin[0], end[1] - origin[1], end[2] - origin[2]};
      LaneDoubles depth_m;
      cones_->FindDepths(direction, window_, depth_m);
      const LaneDoubles marked_m = depth_m * (started[i].t_delta[axis_] / grid_.resolution_m());
      const LaneDoubles before_end_m = started[i].length_m - 2 * grid_.resolution_m();
      until_m[i] = marked_m < before_end_m ? marked_m : before_end_m;
    }
    SkipLanes(started, until_m);
  }

  void WalkReady() {
    static const WindowWalk walk = FastestWindowWalk();
    walk(ready_, window_.words());
    ready_.clear();
  }

  const VoxelGrid& grid_;
  const RayRounds& rays_;
  BitWindow& window_;
  int axis_;
  std::optional<MarkedCones> cones_;  // if all rays have one origin
  std::vector<WindowRays> ready_;
};

}  // namespace

// A ray strays by less than a voxel from its segment.
BlockRange BlocksAround(const VoxelGrid& grid, const RayBoxes& boxes) {
  const auto block_at = [&](const Eigen::Vector3f& p, int stray) {
    const VoxelKey key = grid.KeyOf(p.cast<double>());
    return BlockOf(VoxelKey{key.x + stray, key.y + stray, key.z + stray});
  };
  const Eigen::AlignedBox3f box = boxes.origins.merged(boxes.ends);
  return {block_at(box.min(), -2), block_at(box.max(), 2)};
}

void MarkRays(const VoxelGrid& grid, const RayRounds& rays, bool one_origin, BitWindow& window) {
  if (rays.size() == 0) return;
  Marker marker(grid, rays, one_origin, window);
  for (std::size_t round = 0; round < RayRounds::kCount; ++round) marker.Walk(round);
}

void MarkShortRays(const VoxelGrid& grid, std::span<const RaySegments> rays, BitWindow& window) {
  static const WindowWalk walk = FastestShortWindowWalk();
  std::array<WindowRays, kWalkedTogether> ready;
  for (std::size_t begin = 0; begin < rays.size(); begin += ready.size()) {
    const std::size_t count = std::min(ready.size(), rays.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      RayLanes started;
      StartLanes(grid, rays[begin + i], started);
      PlaceInWindow(started, window, ready[i]);
    }
    walk(std::span(ready).first(count), window.words());
  }
}

}  // namespace clearway
