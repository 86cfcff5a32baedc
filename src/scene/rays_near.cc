#include "scene/rays_near.h"

namespace clearway {
namespace {

// Whether the line passes a ball: most of a frame's rays go elsewhere.
bool MayReach(const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
              const Eigen::Vector3d& center, double radius_m) {
  const Eigen::Vector3d ray = (end - origin).cast<double>();
  const Eigen::Vector3d to_center = center - origin.cast<double>();
  return ray.cross(to_center).squaredNorm() <= radius_m * radius_m * ray.squaredNorm();
}

}  // namespace

ClippedRays RaysWithin(const Aabb& box_O, const Pose& T_W_O, const LabelledCloud& cloud,
                       const SceneParams& params) {
  const Pose T_O_W = Inverse(T_W_O);
  const Eigen::Vector3d center_W = T_W_O * box_O.Center();
  const double reach_m = 0.501 * box_O.Size().norm();
  const VoxelGrid grid(params.resolution_m);
  ClippedRays rays;
  for (std::size_t i = 0; i < cloud.ends_W.size(); ++i) {
    const Eigen::Vector3f& origin_W =
        cloud.origins_W.size() == 1 ? cloud.origins_W[0] : cloud.origins_W[i];
    if (!MayReach(origin_W, cloud.ends_W[i], center_W, reach_m)) continue;
    const LimitedRay limited = LimitRay(grid, params.rays, origin_W, cloud.ends_W[i]);
    const Eigen::Vector3d origin_O = T_O_W * origin_W.cast<double>();
    const Eigen::Vector3d end_O = T_O_W * limited.end.cast<double>();
    const auto [begin, end] = Clip(box_O, origin_O, end_O - origin_O, {0, 1});
    if (begin > end) continue;
    const bool returned = end == 1 && limited.within_range && cloud.kinds[i] != RayEnd::kClear;
    rays.origins_O.push_back((origin_O + begin * (end_O - origin_O)).cast<float>());
    rays.ends_O.push_back((origin_O + end * (end_O - origin_O)).cast<float>());
    rays.kinds.push_back(returned ? RayEnd::kBlock : RayEnd::kClear);
  }
  return rays;
}

}  // namespace clearway
