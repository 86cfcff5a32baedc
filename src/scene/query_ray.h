// How a ray is cast through a scene, whoever knows what is where.
#pragma once

#include "clearway/map/ray.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// A ray in the frame W of a scene, up to a range. It must not outlive the scene.
class QueryRay {
 public:
  QueryRay(const SceneSnapshot& scene, const Eigen::Vector3d& origin_W,
           const Eigen::Vector3d& direction_W, double max_range_m)
      : scene_(scene),
        origin_W_(origin_W),
        unit_W_(direction_W.normalized()),
        max_range_m_(max_range_m) {}

  // What the ray meets first, by at(p_W) -> PointOccupancy of the points asked for. Ends soon after
  // stop(), which is asked every so often, says so; then the answer means nothing.
  template <class At, class Stop>
  RayAnswer Cast(At&& at, Stop&& stop) const;

 private:
  static constexpr int kVoxelsPerLook = 64;

  const SceneSnapshot& scene_;
  Eigen::Vector3d origin_W_, unit_W_;
  double max_range_m_;
};

// Implementation.

template <class At, class Stop>
RayAnswer QueryRay::Cast(At&& at, Stop&& stop) const {
  RayAnswer answer;
  const VoxelGrid& grid = scene_.static_map_W.grid();
  Aabb space = scene_.params.bounds_W;
  space.min = space.min.cwiseMax(-grid.limit_m());
  space.max = space.max.cwiseMin(grid.limit_m());
  if (!space.Contains(origin_W_)) {
    answer.first_unknown_m = 0;
    return answer;
  }
  const LinePart inside = Clip(space, origin_W_, unit_W_, {0, max_range_m_});
  const Eigen::Vector3d end_W = origin_W_ + inside.end * unit_W_;
  bool go_on = true;
  int looks = 0;
  const auto look_at = [&](VoxelKey key) {
    const LinePart in_voxel = Clip(grid.BoxOf(key), origin_W_, unit_W_, inside);
    if (in_voxel.begin > in_voxel.end) return true;  // the walk's float end strays from the ray
    const double middle_m = 0.5 * (in_voxel.begin + in_voxel.end);
    const PointOccupancy found = at(origin_W_ + middle_m * unit_W_);
    if (found.status == SpaceStatus::kOccupied) {
      answer.first_hit_m = in_voxel.begin;
      answer.object = found.object;
    } else if (found.status != SpaceStatus::kFree && !answer.first_unknown_m) {
      answer.first_unknown_m = in_voxel.begin;
    }
    go_on = !answer.first_hit_m && (++looks % kVoxelsPerLook != 0 || !stop());
    return go_on;
  };
  WalkRay(grid, origin_W_.cast<float>(), end_W.cast<float>(), look_at);
  if (go_on) look_at(grid.KeyOf(end_W));
  return answer;
}

}  // namespace clearway
