#include "map/grazed_voxels.h"

#include <algorithm>
#include <vector>

#include "clearway/map/ray.h"
#include "map/surface_layers.h"

namespace clearway {
namespace {

// The occupied voxels that the update has misses of, by blocks. They are few.
std::vector<BitWindow::Block> MissedOccupied(const VoxelMap& map, const ScanUpdate& update) {
  const std::vector<BlockKey>& keys = update.keys();
  std::vector<const VoxelBlock*> blocks(keys.size());
  map.blocks().FindOccupied(keys, blocks.data());
  std::vector<BitWindow::Block> missed;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (blocks[i] == nullptr) continue;
    BlockMask mask = blocks[i]->occupied;
    mask &= update.block(i).free;
    mask.Subtract(update.block(i).end);
    if (mask.Any()) missed.push_back({keys[i], mask});
  }
  return missed;
}

// What part of a ray, from its end back to its origin, lies in the layer of its end voxel that is
// level along one of the axes. A little more, so that the voxel where it ends is the next layer's.
float PartInLayer(const VoxelGrid& grid, VoxelKey end_voxel, unsigned axes, const RaySegment& ray) {
  const std::int32_t voxel[3] = {end_voxel.x, end_voxel.y, end_voxel.z};
  const double beyond_m = 1e-4 * grid.resolution_m();
  double part = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if ((axes >> axis & 1) == 0) continue;
    const double end_m = ray.end[axis], back_m = ray.origin[axis] - end_m;
    const double low_m = voxel[axis] * grid.resolution_m();
    const double to_border_m = back_m < 0 ? end_m - low_m : low_m + grid.resolution_m() - end_m;
    const double leaves_m = to_border_m + beyond_m;
    part = std::max(part, leaves_m < std::abs(back_m) ? leaves_m / std::abs(back_m) : 1.0);
  }
  return static_cast<float>(part);
}

// Finds the stretches, from their ends back, along which rays spare what is occupied. One thread.
class Stretcher {
 public:
  Stretcher(const VoxelGrid& grid, const SurfaceLayers& layers, double grazing_m)
      : grid_(grid), layers_(layers), grazing_m_(static_cast<float>(grazing_m)) {}

  RaySegment Of(const RaySegment& ray) {
    const VoxelKey end = grid_.KeyOf(ray.end.cast<double>());
    const Eigen::Vector3f back = ray.origin - ray.end;
    const float in_layer = PartInLayer(grid_, end, AxesAcross(BesideIn(BlockOf(end)), end), ray);
    const float part = std::min(grazing_m_ / back.norm(), in_layer);
    return {ray.end, part < 1 ? Eigen::Vector3f(ray.end + part * back) : ray.origin};
  }

 private:
  // Rays that follow each other often end in one block.
  const SurfaceLayers::Beside& BesideIn(BlockKey block) {
    if (beside_ == nullptr || block != block_) beside_ = &layers_.In(block);
    block_ = block;
    return *beside_;
  }

  const VoxelGrid& grid_;
  const SurfaceLayers& layers_;
  float grazing_m_;
  BlockKey block_;
  const SurfaceLayers::Beside* beside_ = nullptr;
};

}  // namespace

void SpareGrazed(const VoxelMap& map, std::span<const RaySegment> rays, double grazing_m,
                 ThreadPool& pool, PassedVoxels& stretches, ScanUpdate& update) {
  const std::vector<BitWindow::Block> missed = MissedOccupied(map, update);
  if (missed.empty()) return;
  const SurfaceLayers layers(map, update, pool);
  std::vector<RaySegment> found(rays.size());
  pool.ParallelFor(rays.size(), [&](int, std::size_t begin, std::size_t end) {
    Stretcher stretcher(map.grid(), layers, grazing_m);
    for (std::size_t i = begin; i < end; ++i) found[i] = stretcher.Of(rays[i]);
  });
  stretches.Clear();
  for (const RaySegment& stretch : found) stretches.Add(stretch);
  const std::vector<BlockMask> grazed = stretches.Among(missed, map.grid(), pool);
  for (std::size_t i = 0; i < missed.size(); ++i) {
    if (grazed[i].Any()) update.MarkEnd(missed[i].key, grazed[i]);
  }
}

}  // namespace clearway
