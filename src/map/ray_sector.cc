#include "map/ray_sector.h"

#include "clearway/map/ray.h"
#include "clearway/map/scan_update.h"

namespace clearway {

void RaySector::Clear() {
  rays_.Clear();
  blocks_.clear();
}

const std::vector<BitWindow::Block>& RaySector::Mark(const VoxelGrid& grid,
                                                     std::atomic<std::int64_t>& left) {
  if (size() == 0 || left < 0) return blocks_;
  rays_.Finish();
  const RayBoxes boxes = rays_.BoxesAround();
  const auto [first, last] = BlocksAround(grid, boxes);
  if (BitWindow::Fits(first, last)) {
    MarkInWindow(grid, boxes, first, last);
    left -= static_cast<std::int64_t>(blocks_.size());
  } else {
    MarkSparsely(grid, left);
  }
  return blocks_;
}

void RaySector::MarkInWindow(const VoxelGrid& grid, const RayBoxes& boxes, BlockKey first,
                             BlockKey last) {
  window_.Cover(first, last);
  const bool one_origin = boxes.origins.min() == boxes.origins.max();
  MarkRays(grid, rays_, one_origin, window_);
  for (std::size_t row = 0; row < window_.rows(); ++row) window_.TakeRow(row, blocks_);
}

void RaySector::MarkSparsely(const VoxelGrid& grid, std::atomic<std::int64_t>& left) {
  ScanUpdate update;
  bool too_many = false;
  const auto mark = [&](VoxelKey key) {
    const std::size_t before = update.keys().size();
    update.MarkFree(key);
    if (update.keys().size() != before) too_many = --left < 0;
    return !too_many;
  };
  rays_.ForEach([&](const RaySegment& ray) {
    if (!too_many) WalkRay(grid, ray.origin, ray.end, mark);
  });
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    blocks_.push_back({update.keys()[i], update.block(i).free});
  }
}

}  // namespace clearway
