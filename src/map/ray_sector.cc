#include "map/ray_sector.h"

#include "clearway/map/ray.h"
#include "clearway/map/scan_update.h"

namespace clearway {

void RaySector::Clear() {
  rays_.Clear();
  blocks_.clear();
}

const std::vector<BitWindow::Block>& RaySector::Mark(const VoxelGrid& grid) {
  if (size() == 0) return blocks_;
  rays_.Finish();
  const RayRounds::Boxes boxes = rays_.BoxesAround();
  const auto [first, last] = BlocksAround(grid, boxes);
  if (!BitWindow::Fits(first, last)) {
    MarkSparsely(grid);
    return blocks_;
  }
  window_.Cover(first, last);
  const bool one_origin = boxes.origins.min() == boxes.origins.max();
  MarkRays(grid, rays_, one_origin, window_);
  for (std::size_t row = 0; row < window_.rows(); ++row) window_.TakeRow(row, blocks_);
  return blocks_;
}

// Without a window, which would be too large.
void RaySector::MarkSparsely(const VoxelGrid& grid) {
  ScanUpdate update;
  rays_.ForEach([&](const RaySegment& ray) {
    WalkRay(grid, ray.origin, ray.end, [&](VoxelKey key) { update.MarkFree(key); });
  });
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    blocks_.push_back({update.keys()[i], update.block(i).free});
  }
}

}  // namespace clearway
