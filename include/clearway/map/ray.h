// Rays through a voxel grid.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <type_traits>

#include "clearway/map/voxel_key.h"

namespace clearway {

// Which rays of a scan are cast.
struct RayOptions {
  // Longer rays clear up to here and hit nothing. Metres; negative: no limit.
  double max_range_m = -1;
  // One ray per distinct end voxel, to its centre (OctoMap's `discretize`), instead of one per
  // point.
  bool discretize = false;
  // A ray that ends on a surface at a grazing angle runs for long through the free half of the
  // voxels that hold the surface. Of what it passes in so many metres before its end and in one
  // layer of voxels with that, what is occupied stays as it is. A layer lies across an axis along
  // which the end's voxel has no occupied neighbour: with one, the surface does not lie in the
  // layer, and the ray meets it head on. With one origin, of rays in a row that end in one voxel
  // the first alone is looked at. Metres; 0: it counts as traversed, as in OctoMap.
  double grazing_m = 0;
  // A ray that is cut at the maximum range, or has no return, clears the voxel that its end lies in
  // too; a cut ray only if its point lies in another voxel. Without that, a hit near the maximum
  // range sets voxels that no later ray on the same line clears. True: such rays leave the voxel of
  // their end as it is, as in OctoMap.
  bool octomap_ends = false;
  bool operator==(const RayOptions&) const = default;
};

// What a ray's end point does.
enum class RayEnd : std::uint8_t {
  kHit,    // raises the voxel that it ends in
  kBlock,  // ends on something that this map does not hold: neither hit nor miss
  kClear,  // no return: clears up to the end point (see RayOptions::octomap_ends)
};

// A cloud of rays in the frame of the grid. Arrays are parallel.
struct RayCloud {
  std::span<const Eigen::Vector3f> ends;
  std::span<const RayEnd> kinds;             // one per end
  std::span<const Eigen::Vector3f> origins;  // one for all, or one per end
};

// A ray about to be walked.
struct RayStart {
  VoxelKey key, end;     // where it starts, and where it ends
  std::int32_t step[3];  // -1, 0 or 1 along x, y, z
  double t_max[3];       // metres along the ray to where it leaves the voxel along each axis
  double t_delta[3];     // metres along the ray from border to border
  double length_m;
};
RayStart StartRay(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end);

// Calls visit(VoxelKey) for each voxel that the segment passes from origin's voxel up to, not
// including, end's voxel. This is OctoMap's computeRayKeys, with its rounding (Amanatides and Woo,
// "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987), so that the voxels are the same ones.
// A visit that returns false is the last. Both points must be addressable in the grid.
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

// About how many voxels the rays pass, each counted as often as it is passed: an estimate of the
// cost of walking them.
double VoxelsPassed(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options);

// Implementation.

template <class Visit>
void WalkRay(const VoxelGrid& grid, const Eigen::Vector3f& origin, const Eigen::Vector3f& end,
             Visit&& visit) {
  const auto go_on = [&](const VoxelKey& key) {
    if constexpr (std::is_same_v<decltype(visit(key)), bool>) {
      return visit(key);
    } else {
      visit(key);
      return true;
    }
  };
  RayStart ray = StartRay(grid, origin, end);
  VoxelKey& key = ray.key;
  if (key == ray.end || !go_on(key)) return;
  std::int32_t* const index[3] = {&key.x, &key.y, &key.z};
  auto& t_max = ray.t_max;
  while (true) {
    const int axis =
        t_max[0] < t_max[1] ? (t_max[0] < t_max[2] ? 0 : 2) : (t_max[1] < t_max[2] ? 1 : 2);
    *index[axis] += ray.step[axis];
    t_max[axis] += ray.t_delta[axis];
    if (key == ray.end) return;
    // Rounding made the ray miss its end voxel: OctoMap stops where the segment's length is used
    // up.
    if (std::min({t_max[0], t_max[1], t_max[2]}) > ray.length_m) return;
    if (!go_on(key)) return;
  }
}

}  // namespace clearway
