#include "clearway/map/ray.h"

#include <vector>

#include "absl/container/flat_hash_set.h"

namespace clearway {
namespace {

// OctoMap's Vector3::norm(): products and sum in float, root in double.
double Norm(const Eigen::Vector3f& v) {
  return std::sqrt(static_cast<double>(v.x() * v.x() + v.y() * v.y() + v.z() * v.z()));
}

const Eigen::Vector3f& OriginOf(const RayCloud& cloud, std::size_t i) {
  return cloud.origins.size() == 1 ? cloud.origins[0] : cloud.origins[i];
}

// Which rays are walked: all, or with `discretize` the first one into each voxel (first of a
// clearing and of a returned ray apart).
std::vector<std::uint32_t> RaysToWalk(const VoxelGrid& grid, const RayCloud& cloud,
                                      bool discretize) {
  std::vector<std::uint32_t> rays;
  rays.reserve(cloud.ends.size());
  absl::flat_hash_set<VoxelKey> returned, cleared;
  const bool distinct = discretize && cloud.origins.size() == 1;
  for (std::size_t i = 0; i < cloud.ends.size(); ++i) {
    auto& seen = cloud.kinds[i] == RayEnd::kClear ? cleared : returned;
    if (!distinct || seen.insert(grid.KeyOf(cloud.ends[i].cast<double>())).second) {
      rays.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return rays;
}

}  // namespace

LimitedRay LimitRay(const VoxelGrid& grid, const RayOptions& options, const Eigen::Vector3f& origin,
                    const Eigen::Vector3f& end) {
  const Eigen::Vector3f target =
      options.discretize ? grid.CenterOf(grid.KeyOf(end.cast<double>())).cast<float>().eval() : end;
  const Eigen::Vector3f difference = target - origin;
  const double length_m = Norm(difference);
  if (options.max_range_m < 0 || length_m <= options.max_range_m) return {target, true};
  const Eigen::Vector3f direction = difference / static_cast<float>(length_m);
  return {origin + direction * static_cast<float>(options.max_range_m), false};
}

ScanUpdate CastRays(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options,
                    ThreadPool& pool) {
  std::vector<ScanUpdate> updates(pool.threads());
  pool.ParallelFor(cloud.ends.size(), [&](int worker, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (cloud.kinds[i] == RayEnd::kClear) continue;
      if (!LimitRay(grid, options, OriginOf(cloud, i), cloud.ends[i]).within_range) continue;
      const VoxelKey key = grid.KeyOf(cloud.ends[i].cast<double>());
      cloud.kinds[i] == RayEnd::kHit ? updates[worker].MarkHit(key) : updates[worker].MarkEnd(key);
    }
  });
  const std::vector<std::uint32_t> rays = RaysToWalk(grid, cloud, options.discretize);
  pool.ParallelFor(rays.size(), [&](int worker, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Eigen::Vector3f& origin = OriginOf(cloud, rays[r]);
      const LimitedRay ray = LimitRay(grid, options, origin, cloud.ends[rays[r]]);
      WalkRay(grid, origin, ray.end, [&](VoxelKey key) { updates[worker].MarkFree(key); });
    }
  });
  for (int worker = 1; worker < pool.threads(); ++worker) updates[0].Merge(updates[worker]);
  return std::move(updates[0]);
}

}  // namespace clearway
