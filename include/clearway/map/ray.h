// Rays through a voxel grid, and the update that a cloud of them makes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "clearway/base/thread_pool.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// Which rays of a scan are cast.
struct RayOptions {
  // Longer rays clear up to here and hit nothing. Metres; negative: no limit.
  double max_range_m = -1;
  // One ray per distinct end voxel, to its centre (OctoMap's `discretize`), instead of one per
  // point.
  bool discretize = false;
  bool operator==(const RayOptions&) const = default;
};

// What a ray's end point does.
enum class RayEnd : std::uint8_t {
  kHit,    // raises the voxel that it ends in
  kBlock,  // ends on something that this map does not hold: neither hit nor miss
  kClear,  // no return: clears up to the end point, which is itself left as it is
};

// A cloud of rays in the frame of the grid. Arrays are parallel.
struct RayCloud {
  std::span<const Eigen::Vector3f> ends;
  std::span<const RayEnd> kinds;             // one per end
  std::span<const Eigen::Vector3f> origins;  // one for all, or one per end
};

// Calls visit(VoxelKey) for each voxel that the segment passes from origin's voxel up to, not
// including, end's voxel. This is OctoMap's computeRayKeys, with its rounding (Amanatides and Woo,
// "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987), so that the voxels are the same ones.
// Both points must be addressable in the grid.
template <class Visit>
void WalkRay(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
             Visit&& visit);

// Where a ray ends after RayOptions are applied to it.
struct LimitedRay {
  Eigen::Vector3f end;
  bool within_range;  // false: `end` was pulled in to the maximum range
};
LimitedRay LimitRay(const VoxelGrid& grid, const RayOptions& options, const Eigen::Vector3f& origin,
                    const Eigen::Vector3f& end);

// The update of a map by a cloud: the same voxels as OctoMap's computeUpdate makes of it, whatever
// the number of threads. All points must be addressable in the grid.
ScanUpdate CastRays(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options,
                    ThreadPool& pool);

// Implementation.

template <class Visit>
void WalkRay(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
             Visit&& visit) {
  VoxelKey key = grid.KeyOf(origin.cast<double>());
  const VoxelKey end_key = grid.KeyOf(end.cast<double>());
  if (key == end_key) return;
  visit(key);

  // OctoMap mixes single and double precision here; so must we, to round alike.
  const Eigen::Vector3f difference = end - origin;
  const float length = static_cast<float>(std::sqrt(
      static_cast<double>(difference.x() * difference.x() + difference.y() * difference.y() +
                          difference.z() * difference.z())));
  const double resolution_m = grid.resolution_m();
  std::int32_t* const index[3] = {&key.x, &key.y, &key.z};
  int step[3];
  double t_max[3], t_delta[3];
  for (int i = 0; i < 3; ++i) {
    const float direction = difference[i] / length;
    step[i] = direction > 0 ? 1 : direction < 0 ? -1 : 0;
    if (step[i] == 0) {
      t_max[i] = t_delta[i] = std::numeric_limits<double>::max();
      continue;
    }
    const double border = grid.Center(*index[i]) + static_cast<float>(step[i] * resolution_m * 0.5);
    t_max[i] = (border - origin[i]) / direction;
    t_delta[i] = resolution_m / std::abs(static_cast<double>(direction));
  }
  while (true) {
    const int axis =
        t_max[0] < t_max[1] ? (t_max[0] < t_max[2] ? 0 : 2) : (t_max[1] < t_max[2] ? 1 : 2);
    *index[axis] += step[axis];
    t_max[axis] += t_delta[axis];
    if (key == end_key) return;
    // Rounding made the ray miss its end voxel: OctoMap stops where the segment's length is used
    // up.
    if (std::min({t_max[0], t_max[1], t_max[2]}) > length) return;
    visit(key);
  }
}

}  // namespace clearway
