#include "map/ray_sectors.h"

#include <algorithm>

namespace clearway {

void RaySectors::Clear() {
  for (RaySector& sector : sectors_) sector.Clear();
}

// The largest first, so that the threads end at about the same time.
RaySectors::Marked RaySectors::Mark(const VoxelGrid& grid, ThreadPool& pool) {
  std::array<RaySector*, RaySector::kCount> order;
  for (int s = 0; s < RaySector::kCount; ++s) order[s] = &sectors_[s];
  std::stable_sort(order.begin(), order.end(),
                   [](const RaySector* a, const RaySector* b) { return a->size() > b->size(); });
  Marked marked;
  pool.ParallelChunks(order.size(), 1,
                      [&](int, std::size_t s, std::size_t) { marked[s] = order[s]->Mark(grid); });
  return marked;
}

}  // namespace clearway
