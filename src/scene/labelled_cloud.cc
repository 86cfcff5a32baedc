#include "scene/labelled_cloud.h"

#include <algorithm>
#include <array>
#include <span>

namespace clearway {
namespace {

bool InAny(const std::vector<Aabb>& boxes, const Eigen::Vector3d& p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return box.Contains(p); });
}

RayEnd KindOf(const Frame& frame, std::size_t i) {
  if (!frame.no_return.empty() && frame.no_return[i] != 0) return RayEnd::kClear;
  return frame.labels[i] == kStaticLabel ? RayEnd::kHit : RayEnd::kBlock;
}

// Where many drivers write returns that were lost. With origins of their own, points at them are
// points of which the rays are not known.
bool IsLostReturn(const Frame& frame, std::size_t i) {
  return frame.origins_S.empty() && frame.points_S[i] == Eigen::Vector3f::Zero();
}

struct PlacedRay {
  Eigen::Vector3d end_W, origin_W;
};

// Null if the point is used; else where it is counted.
std::size_t FrameReport::*ReasonToLeaveOut(const Frame& frame, std::size_t i, const PlacedRay& ray,
                                           const SceneParams& params, const VoxelGrid& grid) {
  if (frame.labels[i] == kIgnoreLabel) return &FrameReport::points_ignored;
  if (!frame.points_S[i].allFinite() || IsLostReturn(frame, i) ||
      (!frame.origins_S.empty() && !frame.origins_S[i].allFinite())) {
    return &FrameReport::points_not_finite;
  }
  if (InAny(params.self_filter_S, frame.points_S[i].cast<double>())) {
    return &FrameReport::points_self;
  }
  if (!params.bounds_W.Contains(ray.end_W) || !grid.Addressable(ray.end_W) ||
      !grid.Addressable(ray.origin_W)) {
    return &FrameReport::points_out_of_bounds;
  }
  return nullptr;
}

// What every usable point lies in.
Aabb UsableBox(const SceneParams& params, const VoxelGrid& grid) {
  const Eigen::Vector3d limit = Eigen::Vector3d::Constant(grid.limit_m());
  return {params.bounds_W.min.cwiseMax(-limit), params.bounds_W.max.cwiseMin(limit)};
}

void Add(const Frame& frame, std::size_t i, const PlacedRay& ray, const SceneParams& params,
         const VoxelGrid& grid, LabelledCloud& cloud) {
  cloud.ends_W.push_back(ray.end_W.cast<float>());
  cloud.kinds.push_back(KindOf(frame, i));
  cloud.labels.push_back(frame.labels[i]);
  if (!frame.origins_S.empty()) cloud.origins_W.push_back(ray.origin_W.cast<float>());
  if (cloud.kinds.back() != RayEnd::kBlock) return;
  if (LimitRay(grid, params.rays, ray.origin_W.cast<float>(), cloud.ends_W.back()).within_range) {
    cloud.object_hits[frame.labels[i]].push_back(
        static_cast<std::uint32_t>(cloud.ends_W.size() - 1));
  }
}

}  // namespace

std::vector<Eigen::Vector3d> EndsOf(const LabelledCloud& cloud,
                                    std::span<const std::uint32_t> points) {
  std::vector<Eigen::Vector3d> ends_W;
  ends_W.reserve(points.size());
  for (const std::uint32_t i : points) ends_W.push_back(cloud.ends_W[i].cast<double>());
  return ends_W;
}

LabelledCloud PlaceCloud(const Frame& frame, const SceneParams& params, FrameReport& report) {
  constexpr std::size_t kTogether = 256;  // points placed at once
  const VoxelGrid grid(params.resolution_m);
  const Pose T_W_S{frame.T_W_S.rotation.normalized(), frame.T_W_S.translation};
  const std::size_t size = frame.points_S.size();
  LabelledCloud cloud;
  cloud.ends_W.reserve(size);
  cloud.kinds.reserve(size);
  cloud.labels.reserve(size);
  const bool one_origin = frame.origins_S.empty();
  if (one_origin) cloud.origins_W = {T_W_S.translation.cast<float>()};
  // A point that is not finite lies in no box.
  const bool usable_by_place =
      one_origin && grid.Addressable(T_W_S.translation) && params.self_filter_S.empty();
  const Aabb usable_W = UsableBox(params, grid);
  std::array<Eigen::Vector3d, kTogether> ends_W;
  for (std::size_t i = 0; i < size; ++i) {
    if (i % kTogether == 0) {
      TransformAll(T_W_S, std::span(frame.points_S).subspan(i, std::min(kTogether, size - i)),
                   ends_W.data());
    }
    const PlacedRay ray{ends_W[i % kTogether],
                        one_origin ? T_W_S.translation : T_W_S * frame.origins_S[i].cast<double>()};
    const bool surely_used = usable_by_place && frame.labels[i] != kIgnoreLabel &&
                             usable_W.Contains(ray.end_W) && !IsLostReturn(frame, i);
    if (!surely_used) {
      if (const auto counter = ReasonToLeaveOut(frame, i, ray, params, grid)) {
        ++(report.*counter);
        continue;
      }
    }
    ++report.points_used;
    Add(frame, i, ray, params, grid, cloud);
  }
  return cloud;
}

}  // namespace clearway
