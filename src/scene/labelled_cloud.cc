#include "scene/labelled_cloud.h"

#include <algorithm>

namespace clearway {
namespace {

bool InAny(const std::vector<Aabb>& boxes, const Eigen::Vector3d& p) {
  return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return box.Contains(p); });
}

RayEnd KindOf(const Frame& frame, std::size_t i) {
  if (!frame.no_return.empty() && frame.no_return[i] != 0) return RayEnd::kClear;
  return frame.labels[i] == kStaticLabel ? RayEnd::kHit : RayEnd::kBlock;
}

// Null if the point is used; else where it is counted.
std::size_t FrameReport::*ReasonToLeaveOut(const Frame& frame, std::size_t i,
                                           const SceneParams& params, const Pose& T_W_S,
                                           const VoxelGrid& grid) {
  if (frame.labels[i] == kIgnoreLabel) return &FrameReport::points_ignored;
  if (!frame.points_S[i].allFinite() ||
      (!frame.origins_S.empty() && !frame.origins_S[i].allFinite())) {
    return &FrameReport::points_not_finite;
  }
  const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
  if (InAny(params.self_filter_S, p_S)) return &FrameReport::points_self;
  const Eigen::Vector3d p_W = T_W_S * p_S;
  const Eigen::Vector3d origin_W =
      frame.origins_S.empty() ? T_W_S.translation : T_W_S * frame.origins_S[i].cast<double>();
  if (!params.bounds_W.Contains(p_W) || !grid.Addressable(p_W) || !grid.Addressable(origin_W)) {
    return &FrameReport::points_out_of_bounds;
  }
  return nullptr;
}

}  // namespace

LabelledCloud PlaceCloud(const Frame& frame, const SceneParams& params, FrameReport& report) {
  const VoxelGrid grid(params.resolution_m);
  const Pose T_W_S{frame.T_W_S.rotation.normalized(), frame.T_W_S.translation};
  LabelledCloud cloud;
  cloud.ends_W.reserve(frame.points_S.size());
  if (frame.origins_S.empty()) cloud.origins_W = {T_W_S.translation.cast<float>()};
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    if (auto counter = ReasonToLeaveOut(frame, i, params, T_W_S, grid)) {
      ++(report.*counter);
      continue;
    }
    ++report.points_used;
    cloud.ends_W.push_back((T_W_S * frame.points_S[i].cast<double>()).cast<float>());
    cloud.kinds.push_back(KindOf(frame, i));
    cloud.labels.push_back(frame.labels[i]);
    if (!frame.origins_S.empty()) {
      cloud.origins_W.push_back((T_W_S * frame.origins_S[i].cast<double>()).cast<float>());
    }
    if (cloud.kinds.back() != RayEnd::kBlock) continue;
    const Eigen::Vector3f& origin =
        cloud.origins_W.size() == 1 ? cloud.origins_W.front() : cloud.origins_W.back();
    if (LimitRay(grid, params.rays, origin, cloud.ends_W.back()).within_range) {
      cloud.object_hits[frame.labels[i]].push_back(
          static_cast<std::uint32_t>(cloud.ends_W.size() - 1));
    }
  }
  return cloud;
}

}  // namespace clearway
