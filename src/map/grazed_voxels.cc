#include "map/grazed_voxels.h"

#include <algorithm>
#include <array>

namespace clearway {
namespace {

// The occupied voxels that the update has misses of, by blocks. They are few.
std::vector<BitWindow::Block> MissedOccupied(const VoxelMap& map, const ScanUpdate& update) {
  constexpr std::size_t kTogether = 256;  // blocks whose memory is waited for at once
  const std::span<const BlockKey> keys = update.keys();
  std::vector<BitWindow::Block> missed;
  for (std::size_t begin = 0; begin < keys.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, keys.size() - begin);
    std::array<const VoxelBlock*, kTogether> blocks;
    map.blocks().FindOccupied(keys.subspan(begin, count), blocks.data());
    for (std::size_t i = 0; i < count; ++i) {
      if (blocks[i] == nullptr) continue;
      const ScanUpdate::Block& scan = update.block(begin + i);
      BlockMask mask = blocks[i]->occupied;
      mask &= scan.free;
      mask.Subtract(scan.end);
      if (mask.Any()) missed.push_back({keys[begin + i], mask});
    }
  }
  return missed;
}

constexpr std::size_t kRaysTogether = 4096;

// Some of so many rays. Hardly a branch picks them: no processor could foresee which way it goes.
struct PickedRays {
  std::array<std::uint32_t, kRaysTogether> rays;
  std::array<std::uint8_t, kRaysTogether> axes;  // AxesAcross, where they end
  std::size_t size = 0;
};

// The voxel that the last ray before ray i ends in. There may be none.
const VoxelKey* LastVoxelBefore(const EndingRays& rays, std::size_t i) {
  while (i > 0) {
    if (rays.places[--i] != EndingRays::kNotEnding) return &rays.voxels[i];
  }
  return nullptr;
}

// Those that end; with one origin, of those in a row in one voxel the first alone.
void PickEnding(const EndingRays& rays, std::size_t begin, std::size_t end, PickedRays& picked) {
  const bool one_origin = rays.origins.size() == 1;
  const VoxelKey* last = LastVoxelBefore(rays, begin);
  VoxelKey last_voxel = last == nullptr ? VoxelKey{} : *last;
  bool is_first = !one_origin || last == nullptr;
  picked.size = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (rays.places[i] == EndingRays::kNotEnding) continue;
    const VoxelKey voxel = rays.voxels[i];
    const bool is_other =
        ((voxel.x ^ last_voxel.x) | (voxel.y ^ last_voxel.y) | (voxel.z ^ last_voxel.z)) != 0;
    picked.rays[picked.size] = static_cast<std::uint32_t>(i);
    picked.size += is_first | is_other;
    is_first = !one_origin;
    last_voxel = voxel;
  }
}

// Those that may run in a layer.
void KeepInLayers(const EndingRays& rays, const SurfaceLayers& layers, PickedRays& picked) {
  std::size_t size = 0;
  for (std::size_t k = 0; k < picked.size; ++k) {
    const std::uint32_t i = picked.rays[k];
    const unsigned axes = layers.AxesAcross(rays.places[i], rays.voxels[i]);
    picked.rays[size] = i;
    picked.axes[size] = static_cast<std::uint8_t>(axes);
    size += axes != 0;
  }
  picked.size = size;
}

// What part of a ray, from its end back to its origin, lies in the layer of its end voxel that is
// level along one of the axes. A little more, so that the voxel where it ends is the next layer's.
double PartInLayer(double resolution_m, VoxelKey end_voxel, unsigned axes, const RaySegment& ray) {
  const std::int32_t voxel[3] = {end_voxel.x, end_voxel.y, end_voxel.z};
  const double beyond_m = 1e-4 * resolution_m;
  double part = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low_m = voxel[axis] * resolution_m;
    const double end_m = ray.end[axis], back_m = ray.origin[axis] - end_m;
    const double before_m = end_m - low_m, behind_m = low_m + resolution_m - end_m;
    const double leaves_m = (back_m < 0 ? before_m : behind_m) + beyond_m;
    const double in_layer = std::min(leaves_m / std::abs(back_m), 1.0);
    part = std::max(part, in_layer * static_cast<double>(axes >> axis & 1));
  }
  return part;
}

// The stretch of a ray, from its end back, along which it spares what is occupied.
RaySegment StretchOf(const RaySegment& ray, double part_in_layer, float grazing_m) {
  const Eigen::Vector3f back = ray.origin - ray.end;
  const float part = std::min(grazing_m / back.norm(), static_cast<float>(part_in_layer));
  const Eigen::Vector3f inside = ray.end + part * back;
  return {ray.end, part < 1 ? inside : ray.origin};
}

}  // namespace

void GrazedVoxels::FindStretches(const VoxelGrid& grid, const SurfaceLayers& layers,
                                 const EndingRays& rays, double grazing_m, ThreadPool& pool) {
  const bool one_origin = rays.origins.size() == 1;
  stretches_.resize((rays.ends.size() + kRaysTogether - 1) / kRaysTogether);
  const auto find = [&](int, std::size_t begin, std::size_t end) {
    PickedRays picked;
    PickEnding(rays, begin, end, picked);
    KeepInLayers(rays, layers, picked);
    std::vector<Stretch>& found = stretches_[begin / kRaysTogether];
    found.resize(picked.size);
    for (std::size_t k = 0; k < picked.size; ++k) {
      const std::uint32_t i = picked.rays[k];
      const RaySegment ray{rays.origins[one_origin ? 0 : i], rays.ends[i]};
      const double part = PartInLayer(grid.resolution_m(), rays.voxels[i], picked.axes[k], ray);
      found[k] = {StretchOf(ray, part, static_cast<float>(grazing_m)), rays.sectors[i]};
    }
  };
  pool.ParallelChunks(rays.ends.size(), kRaysTogether, find);
}

void GrazedVoxels::Spare(const VoxelMap& map, const EndingRays& rays, double grazing_m,
                         ThreadPool& pool, ScanUpdate& update) {
  const std::vector<BitWindow::Block> missed = MissedOccupied(map, update);
  if (missed.empty()) return;
  FindStretches(map.grid(), SurfaceLayers(map, update, pool), rays, grazing_m, pool);
  passed_.Clear();
  for (const std::vector<Stretch>& found : stretches_) {
    for (const auto& [segment, sector] : found) passed_.Add(segment, sector);
  }
  const std::vector<BlockMask> grazed = passed_.Among(missed, map.grid(), pool);
  for (std::size_t i = 0; i < missed.size(); ++i) {
    if (grazed[i].Any()) update.MarkEnd(missed[i].key, grazed[i]);
  }
}

}  // namespace clearway
