#include "scene/rays_near.h"

#include <cstdint>
#include <vector>

#include "base/multiversion.h"

namespace clearway {
namespace {

// Of rays from one origin, whether their lines may pass a ball: most of a frame's go elsewhere. The
// ball's centre as seen from the origin.
CLEARWAY_MULTIVERSION void FindNear(const Eigen::Vector3f* ends, std::size_t size,
                                    const Eigen::Vector3f& origin, const Eigen::Vector3f& center,
                                    float radius_m, std::uint8_t* is_near) {
  for (std::size_t i = 0; i < size; ++i) {  // many at a time
    const float* end = ends[i].data();
    const float x = end[0] - origin[0], y = end[1] - origin[1], z = end[2] - origin[2];
    const float across_x = y * center[2] - z * center[1];
    const float across_y = z * center[0] - x * center[2];
    const float across_z = x * center[1] - y * center[0];
    const float square = across_x * across_x + across_y * across_y + across_z * across_z;
    is_near[i] = square <= radius_m * radius_m * (x * x + y * y + z * z);
  }
}

}  // namespace

std::vector<std::uint8_t> RaysNear(const LabelledCloud& cloud, const Eigen::Vector3d& center_W,
                                   double radius_m) {
  const std::size_t size = cloud.ends_W.size();
  const bool one_origin = cloud.origins_W.size() == 1;
  const std::size_t together = one_origin ? size : 1;
  std::vector<std::uint8_t> is_near(size);
  for (std::size_t i = 0; i < size; i += together) {
    const Eigen::Vector3f& origin_W = cloud.origins_W[one_origin ? 0 : i];
    const Eigen::Vector3f center = (center_W - origin_W.cast<double>()).cast<float>();
    FindNear(&cloud.ends_W[i], together, origin_W, center, static_cast<float>(radius_m),
             &is_near[i]);
  }
  return is_near;
}

ClippedRays RaysWithin(const Aabb& box_O, const Pose& T_W_O, const LabelledCloud& cloud,
                       const SceneParams& params) {
  const Pose T_O_W = Inverse(T_W_O);
  const Eigen::Vector3d center_W = T_W_O * box_O.Center();
  const double reach_m = 0.51 * box_O.Size().norm();  // half, and what is rounded
  const std::vector<std::uint8_t> is_near = RaysNear(cloud, center_W, reach_m);
  const VoxelGrid grid(params.resolution_m);
  ClippedRays rays;
  for (std::size_t i = 0; i < cloud.ends_W.size(); ++i) {
    if (is_near[i] == 0) continue;
    const Eigen::Vector3f& origin_W =
        cloud.origins_W.size() == 1 ? cloud.origins_W[0] : cloud.origins_W[i];
    const LimitedRay limited = LimitRay(grid, params.rays, origin_W, cloud.ends_W[i]);
    const Eigen::Vector3d origin_O = T_O_W * origin_W.cast<double>();
    const Eigen::Vector3d end_O = T_O_W * limited.end.cast<double>();
    const auto [begin, end] = Clip(box_O, origin_O, end_O - origin_O, {0, 1});
    if (begin > end) continue;
    const bool returned = end == 1 && limited.within_range && cloud.kinds[i] != RayEnd::kClear;
    rays.origins_O.push_back((origin_O + begin * (end_O - origin_O)).cast<float>());
    rays.ends_O.push_back((origin_O + end * (end_O - origin_O)).cast<float>());
    rays.kinds.push_back(returned ? RayEnd::kBlock : RayEnd::kClear);
    rays.of.push_back(static_cast<std::uint32_t>(i));
  }
  return rays;
}

}  // namespace clearway
