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

constexpr std::size_t kTogether = 4096;  // rays

// Some rays of a range, without branches that a processor cannot foresee.
struct Some {
  std::array<std::uint32_t, kTogether> rays;
  std::array<std::uint8_t, kTogether> axes;  // AxesAcross, where they end
  std::size_t size = 0;
};

// The voxel that the last ray before ray i ends in. There may be none.
const VoxelKey* LastVoxelBefore(const EndingRays& rays, std::size_t i) {
  while (i > 0) {
    if (rays.places[--i] != EndingRays::kNotEnding) return &rays.voxels[i];
  }
  return nullptr;
}

// Those that end, but with one origin, of those in a row in one voxel the first alone.
void KeepEnding(const EndingRays& rays, std::size_t begin, std::size_t end, Some& kept) {
  const bool one_origin = rays.origins.size() == 1;
  const VoxelKey* last = LastVoxelBefore(rays, begin);
  VoxelKey last_voxel = last == nullptr ? VoxelKey{} : *last;
  bool is_first = !one_origin || last == nullptr;
  kept.size = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (rays.places[i] == EndingRays::kNotEnding) continue;
    const VoxelKey voxel = rays.voxels[i];
    const bool is_other = ((voxel.x ^ last_voxel.x) | (voxel.y ^ last_voxel.y) | (voxel.z ^ last_voxel.z)) != 0;
    kept.rays[kept.size] = static_cast<std::uint32_t>(i);
    kept.size += is_first | is_other;
    is_first = !one_origin;
    last_voxel = voxel;
  }
}

// Those that may run in a layer.
void KeepInLayers(const EndingRays& rays, const SurfaceLayers& layers, Some& kept) {
  std::size_t size = 0;
  for (std::size_t k = 0; k < kept.size; ++k) {
    const std::uint32_t i = kept.rays[k];
    const unsigned axes = layers.AxesAcross(rays.places[i], rays.voxels[i]);
    kept.rays[size] = i;
    kept.axes[size] = static_cast<std::uint8_t>(axes);
    size += axes != 0;
  }
  kept.size = size;
}

// What part of a ray, given by its end and what leads from there back to its origin, lies in the
// layer of its end voxel that is level along one of the axes. A little more, so that the voxel
// where it ends is the next layer's.
double PartInLayer(double resolution_m, VoxelKey voxel, unsigned axes, const Eigen::Vector3f& end,
                   const Eigen::Vector3f& back) {
  const std::int32_t index[3] = {voxel.x, voxel.y, voxel.z};
  const double beyond_m = 1e-4 * resolution_m;
  double part = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low_m = index[axis] * resolution_m, end_m = end[axis], back_m = back[axis];
    const double before_m = end_m - low_m, behind_m = low_m + resolution_m - end_m;
    const double to_border_m = back_m < 0 ? before_m : behind_m;
    const double in_layer = std::min((to_border_m + beyond_m) / std::abs(back_m), 1.0);
    part = std::max(part, in_layer * static_cast<double>(axes >> axis & 1));
  }
  return part;
}

}  // namespace

void GrazedVoxels::FindStretches(const VoxelGrid& grid, const SurfaceLayers& layers,
                                 const EndingRays& rays, double grazing_m, ThreadPool& pool) {
  const bool one_origin = rays.origins.size() == 1;
  stretches_.resize((rays.ends.size() + kTogether - 1) / kTogether);
  pool.ParallelChunks(rays.ends.size(), kTogether, [&](int, std::size_t begin, std::size_t end) {
    Some kept;
    KeepEnding(rays, begin, end, kept);
    KeepInLayers(rays, layers, kept);
    std::vector<Stretch>& found = stretches_[begin / kTogether];
    found.resize(kept.size);
    for (std::size_t k = 0; k < kept.size; ++k) {
      const std::uint32_t i = kept.rays[k];
      const Eigen::Vector3f& from = rays.ends[i];
      const Eigen::Vector3f& origin = rays.origins[one_origin ? 0 : i];
      const Eigen::Vector3f back = origin - from;
      const auto in_layer = static_cast<float>(
          PartInLayer(grid.resolution_m(), rays.voxels[i], kept.axes[k], from, back));
      const float part = std::min(static_cast<float>(grazing_m) / back.norm(), in_layer);
      const Eigen::Vector3f inside = from + part * back;
      found[k] = {{from, part < 1 ? inside : origin}, rays.sectors[i]};
    }
  });
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
