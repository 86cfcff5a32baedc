// The update that a cloud of rays makes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "clearway/base/thread_pool.h"
#include "clearway/map/ray.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// The blocks that a cloud's rays may pass through or end in, those where rays of very different
// directions meet counted more than once. More would take gigabytes: a few rays of many kilometres
// do, or a cloud strewn over them. Scattered, a block takes up to 3 KB in the map.
inline constexpr std::size_t kMaxScanBlocks = std::size_t{1} << 20;

// Casts clouds, one after the other; keeps its memory from one to the next. One thread at a time.
class RayCaster {
 public:
  // `pool` must outlive the caster.
  explicit RayCaster(ThreadPool& pool);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  // The update of a map by a cloud, whatever the number of threads: with RayOptions::octomap_ends
  // the voxels that OctoMap's computeUpdate makes of it; grazing_m is not looked at. All points
  // must be addressable in the grid. None if the rays pass through or end in more than
  // kMaxScanBlocks blocks.
  std::optional<ScanUpdate> Cast(const VoxelGrid& grid, const RayCloud& cloud,
                                 const RayOptions& options);
  // The same of that map, which the scan is going to update, with what RayOptions::grazing_m asks
  // for.
  std::optional<ScanUpdate> Cast(const VoxelMap& map, const RayCloud& cloud,
                                 const RayOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
