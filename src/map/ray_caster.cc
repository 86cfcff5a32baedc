#include "clearway/map/ray_caster.h"

#include <vector>

#include "absl/container/flat_hash_set.h"
#include "map/grazed_voxels.h"
#include "map/ray_sectors.h"

namespace clearway {
namespace {

const Eigen::Vector3f& OriginOf(const RayCloud& cloud, std::size_t i) {
  return cloud.origins.size() == 1 ? cloud.origins[0] : cloud.origins[i];
}

// The rays of a cloud after RayOptions: arrays with one entry each.
struct PreparedRays {
  std::vector<VoxelKey> keys;         // of the points, however far they are
  std::vector<Eigen::Vector3f> ends;  // of the rays
  std::vector<std::uint8_t> within_range, sectors;
  std::vector<std::uint32_t> places;  // as EndingRays has them, once the ends are marked

  std::size_t size() const { return keys.size(); }
};

void Prepare(const VoxelGrid& grid, const RayCloud& cloud, const RayOptions& options,
             ThreadPool& pool, PreparedRays& rays) {
  const std::size_t size = cloud.ends.size();
  rays.keys.resize(size);
  rays.ends.resize(size);
  rays.within_range.resize(size);
  rays.sectors.resize(size);
  pool.ParallelFor(size, [&](int, std::size_t begin, std::size_t end) {
    grid.KeysOf(cloud.ends.subspan(begin, end - begin), &rays.keys[begin]);
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f& origin = OriginOf(cloud, i);
      const LimitedRay limited = LimitRay(grid, options, origin, cloud.ends[i]);
      rays.ends[i] = limited.end;
      rays.within_range[i] = limited.within_range;
      rays.sectors[i] = static_cast<std::uint8_t>(RaySector::IndexOf(limited.end - origin));
    }
  });
}

// Calls walk(i) for the rays that are walked: all, or with `distinct` the first one into each voxel
// (first of a clearing and of a returned ray apart).
template <class Walk>
void ForEachRayToWalk(const RayCloud& cloud, const PreparedRays& rays, bool distinct, Walk&& walk) {
  absl::flat_hash_set<VoxelKey> returned, cleared;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    auto& seen = cloud.kinds[i] == RayEnd::kClear ? cleared : returned;
    if (!distinct || seen.insert(rays.keys[i]).second) walk(i);
  }
}

}  // namespace

struct RayCaster::Impl {
  explicit Impl(ThreadPool& the_pool) : pool(the_pool) {}

  ThreadPool& pool;
  // Of the cloud at hand; their memory is kept for the next.
  PreparedRays rays;
  RaySectors sectors;
  GrazedVoxels grazed;

  std::optional<ScanUpdate> Cast(const VoxelGrid& grid, const RayCloud& cloud,
                                 const RayOptions& options);
  // False, and nothing is marked, if it would be too much.
  bool MarkFree(const VoxelGrid& grid, ScanUpdate& update);
  void MarkEnds(const RayCloud& cloud, ScanUpdate& update);
  void MarkFreeEnds(const VoxelGrid& grid, const RayCloud& cloud, ScanUpdate& update) const;
};

bool RayCaster::Impl::MarkFree(const VoxelGrid& grid, ScanUpdate& update) {
  const std::optional<RaySectors::Marked> marked = sectors.Mark(grid, kMaxScanBlocks, pool);
  if (!marked) return false;
  std::size_t count = 0;
  for (const auto& part : *marked) count += part.size();
  update.Reserve(count);
  for (const auto& part : *marked) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      constexpr std::size_t kAhead = 8;
      if (i + kAhead < part.size()) update.Prefetch(part[i + kAhead].key);
      update.MarkFree(part[i].key, part[i].mask);
    }
  }
  return true;
}

void RayCaster::Impl::MarkEnds(const RayCloud& cloud, ScanUpdate& update) {
  rays.places.resize(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (cloud.kinds[i] == RayEnd::kClear || !rays.within_range[i]) {
      rays.places[i] = EndingRays::kNotEnding;
      continue;
    }
    const VoxelKey key = rays.keys[i];
    rays.places[i] = static_cast<std::uint32_t>(
        cloud.kinds[i] == RayEnd::kHit ? update.MarkHit(key) : update.MarkEnd(key));
  }
}

// Walks do not mark the voxel that a ray ends in. A ray without a hit clears it, but not if the
// point beyond the maximum range lies in it. What ends there in the same scan beats that.
void RayCaster::Impl::MarkFreeEnds(const VoxelGrid& grid, const RayCloud& cloud,
                                   ScanUpdate& update) const {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool no_return = cloud.kinds[i] == RayEnd::kClear;
    if (!no_return && rays.within_range[i]) continue;
    const VoxelKey end =
        rays.within_range[i] ? rays.keys[i] : grid.KeyOf(rays.ends[i].cast<double>());
    if (no_return || end != rays.keys[i]) update.MarkFree(end);
  }
}

std::optional<ScanUpdate> RayCaster::Impl::Cast(const VoxelGrid& grid, const RayCloud& cloud,
                                                const RayOptions& options) {
  Prepare(grid, cloud, options, pool, rays);
  sectors.Clear();
  const bool distinct = options.discretize && cloud.origins.size() == 1;
  ForEachRayToWalk(cloud, rays, distinct, [&](std::size_t i) {
    sectors.Add({OriginOf(cloud, i), rays.ends[i]}, rays.sectors[i]);
  });
  ScanUpdate update;
  if (!MarkFree(grid, update)) return std::nullopt;
  if (!options.octomap_ends) MarkFreeEnds(grid, cloud, update);
  MarkEnds(cloud, update);
  if (update.keys().size() > kMaxScanBlocks) return std::nullopt;  // with those of ends
  return update;
}

RayCaster::RayCaster(ThreadPool& pool) : impl_(std::make_unique<Impl>(pool)) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<ScanUpdate> RayCaster::Cast(const VoxelGrid& grid, const RayCloud& cloud,
                                          const RayOptions& options) {
  if (cloud.ends.empty()) return ScanUpdate();
  try {
    return impl_->Cast(grid, cloud, options);
  } catch (...) {  // no memory: what it keeps for the next cloud is half done
    *this = RayCaster(impl_->pool);
    throw;
  }
}

std::optional<ScanUpdate> RayCaster::Cast(const VoxelMap& map, const RayCloud& cloud,
                                          const RayOptions& options) {
  std::optional<ScanUpdate> update = Cast(map.grid(), cloud, options);
  if (!update || options.grazing_m == 0 || cloud.ends.empty()) return update;
  const auto& [keys, ends, within_range, sectors, places] = impl_->rays;
  impl_->grazed.Spare(map, {cloud.origins, ends, keys, places, sectors}, options.grazing_m,
                      impl_->pool, *update);
  return update;
}

}  // namespace clearway
