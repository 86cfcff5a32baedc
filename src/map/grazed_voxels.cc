#include "map/grazed_voxels.h"

#include <algorithm>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/ray.h"
#include "map/surface_layers.h"

namespace clearway {
namespace {

using MaskByBlock = absl::flat_hash_map<BlockKey, BlockMask>;

// The occupied voxels that the update has misses of. They are few.
MaskByBlock MissedOccupied(const VoxelMap& map, const ScanUpdate& update) {
  const std::vector<BlockKey>& keys = update.keys();
  std::vector<const VoxelBlock*> blocks(keys.size());
  map.blocks().FindAll(keys, blocks.data());
  MaskByBlock missed;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (blocks[i] == nullptr) continue;
    BlockMask mask = blocks[i]->occupied;
    mask &= update.block(i).free;
    mask.Subtract(update.block(i).end);
    if (mask.Any()) missed.emplace(keys[i], mask);
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
  Stretcher(const VoxelGrid& grid, const SurfaceLayers& layers, const MaskByBlock& missed,
            double grazing_m)
      : grid_(grid), layers_(layers), missed_(missed), grazing_m_(static_cast<float>(grazing_m)) {}

  // One that goes nowhere if surely nothing missed is on it.
  RaySegment Of(const RaySegment& ray) {
    const VoxelKey end = grid_.KeyOf(ray.end.cast<double>());
    LookIn(BlockOf(end));
    const Eigen::Vector3f back = ray.origin - ray.end;
    const float in_layer = PartInLayer(grid_, end, AxesAcross(*beside_, end), ray);
    const float part = std::min(grazing_m_ / back.norm(), in_layer);
    const Eigen::Vector3f until = part < 1 ? Eigen::Vector3f(ray.end + part * back) : ray.origin;
    if (!missed_here_ && BlockOf(grid_.KeyOf(until.cast<double>())) == block_) {
      return {ray.end, ray.end};
    }
    return {ray.end, until};
  }

 private:
  // Rays that follow each other often end in one block.
  void LookIn(BlockKey block) {
    if (beside_ != nullptr && block == block_) return;
    block_ = block;
    beside_ = &layers_.In(block);
    missed_here_ = missed_.contains(block);
  }

  const VoxelGrid& grid_;
  const SurfaceLayers& layers_;
  const MaskByBlock& missed_;
  float grazing_m_;
  BlockKey block_;
  const SurfaceLayers::Beside* beside_ = nullptr;
  bool missed_here_ = false;
};

}  // namespace

void SpareGrazed(const VoxelMap& map, std::span<const RaySegment> rays, double grazing_m,
                 ThreadPool& pool, RaySectors& sectors, ScanUpdate& update) {
  const MaskByBlock missed = MissedOccupied(map, update);
  if (missed.empty()) return;
  const SurfaceLayers layers(map, update, pool);
  std::vector<RaySegment> stretches(rays.size());
  pool.ParallelFor(rays.size(), [&](int, std::size_t begin, std::size_t end) {
    Stretcher stretcher(map.grid(), layers, missed, grazing_m);
    for (std::size_t i = begin; i < end; ++i) stretches[i] = stretcher.Of(rays[i]);
  });
  sectors.Clear();
  for (const RaySegment& stretch : stretches) {
    sectors.Add(stretch, RaySector::IndexOf(stretch.end - stretch.origin));
  }
  for (const auto& part : sectors.Mark(map.grid(), pool)) {
    for (auto [key, grazed] : part) {
      const auto entry = missed.find(key);
      if (entry == missed.end()) continue;
      grazed &= entry->second;
      update.MarkEnd(key, grazed);
    }
  }
}

}  // namespace clearway
