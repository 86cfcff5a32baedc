#include "map/mark_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "map/marked_cones.h"
#include "map/ray_lanes.h"
#include "map/window_walk.h"

namespace clearway {
namespace {

// Rays are walked in rounds: a few that lie apart, some more, then the rest, of which the first
// steps are skipped where the rounds before have marked all there is to mark. Which of thirteen
// rays in a row belong to what round; thirteen divides the width of hardly any camera.
constexpr std::size_t kInARow = 13;
constexpr std::array<std::size_t, 1> kFirstRound{0};
constexpr std::array<std::size_t, 3> kSecondRound{4, 8, 11};
constexpr std::array<std::size_t, 9> kLastRound{1, 2, 3, 5, 6, 7, 9, 10, 12};

constexpr std::size_t kRaysAtOnce = 2048;  // prepared before they are walked

// Narrow cones skip more, but it takes time to look at each. This is flat around the best.
int ConesAcross(std::size_t rays) {
  constexpr double kRays = 8;  // in a narrow cone
  constexpr int kMultiple = 1 << MarkedCones::kLevels;
  const double across = std::sqrt(static_cast<double>(rays) / kRays);
  return kMultiple * std::clamp(static_cast<int>(across / kMultiple), 1, 128 / kMultiple);
}

class Marker {
 public:
  Marker(const VoxelGrid& grid, std::span<const RaySegment> rays, BitWindow& window)
      : grid_(grid), rays_(rays), window_(window), axis_(MainAxis(rays[0].end - rays[0].origin)) {
    const Eigen::Vector3f& origin = rays[0].origin;
    const bool one_origin = std::all_of(
        rays.begin(), rays.end(), [&](const RaySegment& ray) { return ray.origin == origin; });
    if (!one_origin) return;
    cones_.emplace(grid, origin.cast<double>(), axis_, rays[0].end[axis_] < origin[axis_],
                   ConesAcross(rays.size()));
  }

  void Walk(std::span<const std::size_t> in_a_row, bool skip_marked) {
    if (cones_) cones_->NextRound();
    std::array<const RaySegment*, kRayLanes> lanes;
    std::size_t used = 0;
    for (std::size_t row = 0; row < rays_.size(); row += kInARow) {
      for (const std::size_t i : in_a_row) {
        if (row + i >= rays_.size()) break;
        lanes[used++] = &rays_[row + i];
        if (used < lanes.size()) continue;
        Prepare(lanes, skip_marked);
        used = 0;
      }
      if (ready_.size() >= kRaysAtOnce) WalkReady();
    }
    Prepare({lanes.data(), used}, skip_marked);
    WalkReady();
  }

 private:
  void Prepare(std::span<const RaySegment* const> lanes, bool skip_marked) {
    LaneFloats origin[3] = {}, end[3] = {};
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis][lane] = lanes[lane]->origin[axis];
        end[axis][lane] = lanes[lane]->end[axis];
      }
    }
    RayLanes started;
    StartLanes(grid_, origin, end, started);
    if (skip_marked && cones_) SkipMarked(lanes, started);
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      const WindowRay ray = InWindow(started, static_cast<int>(lane), window_);
      if (ray.index != ray.end) ready_.push_back(ray);
    }
  }

  // Past what is marked already, but not to the ends.
  void SkipMarked(std::span<const RaySegment* const> lanes, RayLanes& started) {
    LaneDoubles depth_m{};
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      depth_m[lane] = cones_->Depth_m(lanes[lane]->end - lanes[lane]->origin, window_);
    }
    const LaneDoubles until_m = depth_m * (started.t_delta[axis_] / grid_.resolution_m());
    const LaneDoubles before_end_m = started.length_m - 2 * grid_.resolution_m();
    SkipLanes(started, until_m < before_end_m ? until_m : before_end_m);
  }

  void WalkReady() {
    static const WindowWalk walk = FastestWindowWalk();
    walk(ready_, window_.words());
    ready_.clear();
  }

  const VoxelGrid& grid_;
  std::span<const RaySegment> rays_;
  BitWindow& window_;
  int axis_;
  std::optional<MarkedCones> cones_;  // if all rays have one origin
  std::vector<WindowRay> ready_;
};

}  // namespace

int MainAxis(const Eigen::Vector3f& direction) {
  const Eigen::Vector3f size = direction.cwiseAbs();
  if (size.x() >= size.y() && size.x() >= size.z()) return 0;
  return size.y() >= size.z() ? 1 : 2;
}

void MarkRays(const VoxelGrid& grid, std::span<const RaySegment> rays, BitWindow& window) {
  if (rays.empty()) return;
  Marker marker(grid, rays, window);
  marker.Walk(kFirstRound, false);
  marker.Walk(kSecondRound, true);
  marker.Walk(kLastRound, true);
}

}  // namespace clearway
