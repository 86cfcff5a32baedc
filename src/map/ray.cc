#include "clearway/map/ray.h"

#include <limits>

namespace clearway {
namespace {

// OctoMap's Vector3::norm(): products and sum in float, root in double.
double Norm(const Eigen::Vector3f& v) {
  return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
}

}  // namespace

LimitedRay LimitRay(const VoxelGrid& grid, const RayOptions& options, const Eigen::Vector3f& origin,
                    const Eigen::Vector3f& end) {
  const Eigen::Vector3f target =
      options.discretize ? grid.CenterOf(grid.KeyOf(end.cast<double>())).cast<float>().eval() : end;
  if (options.max_range_m < 0) return {target, true};
  const Eigen::Vector3f difference = target - origin;
  const double length_m = Norm(difference);
  if (length_m <= options.max_range_m) return {target, true};
  const Eigen::Vector3f direction = difference / static_cast<float>(length_m);
  return {origin + direction * static_cast<float>(options.max_range_m), false};
}

double VoxelsPassed(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options) {
  const float most_m = options.max_range_m < 0 ? std::numeric_limits<float>::infinity()
                                               : static_cast<float>(options.max_range_m);
  double steps_m = 0;
  for (std::size_t i = 0; i < cloud.ends.size(); ++i) {
    const Eigen::Vector3f ray = cloud.ends[i] - cloud.origins[cloud.origins.size() == 1 ? 0 : i];
    const float length_m = ray.norm();
    steps_m += ray.cwiseAbs().sum() * (length_m > most_m ? most_m / length_m : 1.0f);
  }
  return steps_m / grid.resolution_m() + static_cast<double>(cloud.ends.size());
}

// OctoMap mixes single and double precision here; so must we, to round alike. StartLanes does the
// same for eight rays.
RayStart StartRay(const VoxelGrid& grid, const Eigen::Vector3f& origin,
                  const Eigen::Vector3f& end) {
  RayStart ray;
  ray.key = grid.KeyOf(origin.cast<double>());
  ray.end = grid.KeyOf(end.cast<double>());
  const Eigen::Vector3f difference = end - origin;
  const float length = static_cast<float>(Norm(difference));
  ray.length_m = length;
  const double resolution_m = grid.resolution_m();
  const std::int32_t index[3] = {ray.key.x, ray.key.y, ray.key.z};
  for (int i = 0; i < 3; ++i) {
    // No direction if the end is so near that single precision has no length for it.
    const float direction = length > 0 ? difference[i] / length : 0;
    ray.step[i] = direction > 0 ? 1 : direction < 0 ? -1 : 0;
    if (ray.step[i] == 0) {
      ray.t_max[i] = ray.t_delta[i] = std::numeric_limits<double>::max();
      continue;
    }
    const double border =
        grid.Center(index[i]) + static_cast<float>(ray.step[i] * resolution_m * 0.5);
    ray.t_max[i] = (border - origin[i]) / direction;
    ray.t_delta[i] = resolution_m / std::abs(static_cast<double>(direction));
  }
  return ray;
}

}  // namespace clearway
