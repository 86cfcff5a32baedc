// All rays of a cloud, walked by sectors.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "clearway/base/thread_pool.h"
#include "map/ray_sector.h"

namespace clearway {

// Keeps its memory from one cloud to the next. One thread at a time.
class RaySectors {
 public:
  void Clear();
  // `sector`: RaySector::IndexOf the ray's direction.
  void Add(const RaySegment& ray, int sector) { sectors_[sector].Add(ray); }

  // Walks the rays, each sector by one thread: the voxels that WalkRay visits, by blocks. A block
  // is in several sectors' parts where their rays meet. Valid until Clear. None if these parts have
  // more than `most_blocks`.
  using Marked = std::array<std::span<const BitWindow::Block>, RaySector::kCount>;
  std::optional<Marked> Mark(const VoxelGrid& grid, std::size_t most_blocks, ThreadPool& pool);

 private:
  std::array<RaySector, RaySector::kCount> sectors_;
};

}  // namespace clearway
