#include "map/ray_sectors.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace clearway {

void RaySectors::Clear() {
  for (RaySector& sector : sectors_) sector.Clear();
}

// The largest first, so that the threads end at about the same time.
std::optional<RaySectors::Marked> RaySectors::Mark(const VoxelGrid& grid, std::size_t most_blocks,
                                                   ThreadPool& pool) {
  std::array<RaySector*, RaySector::kCount> order;
  for (int s = 0; s < RaySector::kCount; ++s) order[s] = &sectors_[s];
  std::stable_sort(order.begin(), order.end(),
                   [](const RaySector* a, const RaySector* b) { return a->size() > b->size(); });
  Marked marked;
  std::atomic<std::int64_t> left = static_cast<std::int64_t>(most_blocks);
  pool.ParallelChunks(order.size(), 1, [&](int, std::size_t s, std::size_t) {
    marked[s] = order[s]->Mark(grid, left);
  });
  if (left < 0) return std::nullopt;
  return marked;
}

}  // namespace clearway
