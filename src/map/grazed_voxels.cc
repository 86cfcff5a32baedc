#include "map/grazed_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/multiversion.h"

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

// Eight of the picked rays, a lane each.
struct EndingEight {
  RaySegments rays;
  LaneInts voxel[3];  // of the end
  LaneInts axes;
};

// From pick k on; after the last, that one again.
void Gather(const EndingRays& rays, const PickedRays& picked, std::size_t k, EndingEight& eight) {
  const bool one_origin = rays.origins.size() == 1;
  for (int lane = 0; lane < kLanes; ++lane) {
    const std::size_t pick = std::min(k + lane, picked.size - 1);
    const std::uint32_t i = picked.rays[pick];
    const VoxelKey voxel = rays.voxels[i];
    Put({rays.origins[one_origin ? 0 : i], rays.ends[i]}, lane, eight.rays);
    eight.voxel[0][lane] = voxel.x;
    eight.voxel[1][lane] = voxel.y;
    eight.voxel[2][lane] = voxel.z;
    eight.axes[lane] = picked.axes[pick];
  }
}

// What part of each ray, from its end back to its origin, lies in the layer of its end voxel that
// is level along one of the axes. A little more, so that the voxel where it ends is the next
// layer's.
inline void FindPartsInLayer(double resolution_m, const EndingEight& eight, LaneDoubles& part) {
  const double beyond_m = 1e-4 * resolution_m;
  part = LaneDoubles{};
  for (int axis = 0; axis < 3; ++axis) {
    const LaneDoubles low_m =
        __builtin_convertvector(eight.voxel[axis], LaneDoubles) * resolution_m;
    const LaneDoubles end_m = __builtin_convertvector(eight.rays.end[axis], LaneDoubles);
    const LaneDoubles back_m =
        __builtin_convertvector(eight.rays.origin[axis], LaneDoubles) - end_m;
    const LaneDoubles before_m = end_m - low_m, behind_m = low_m + resolution_m - end_m;
    const LaneDoubles leaves_m = (back_m < 0 ? before_m : behind_m) + beyond_m;
    const LaneDoubles in_layer = leaves_m / (back_m < 0 ? -back_m : back_m);
    const LaneInts level = (eight.axes >> axis & 1) != 0;
    const LaneDoubles counted =
        __builtin_convertvector(level, LaneLongs) ? in_layer : LaneDoubles{};
    part = counted > part ? counted : part;
  }
}

// The stretch of each ray, from its end back, along which it spares what is occupied.
CLEARWAY_MULTIVERSION void FindStretchesOf(const EndingEight& eight, double resolution_m,
                                           float grazing_m, RaySegments& stretches) {
  LaneDoubles part_in_layer;
  FindPartsInLayer(resolution_m, eight, part_in_layer);
  const auto& [origin, end] = eight.rays;
  const LaneFloats back[3] = {origin[0] - end[0], origin[1] - end[1], origin[2] - end[2]};
  const LaneFloats square = back[0] * back[0] + back[1] * back[1] + back[2] * back[2];
  LaneFloats length_m;
  for (int lane = 0; lane < kLanes; ++lane) length_m[lane] = std::sqrt(square[lane]);
  const LaneFloats near = grazing_m / length_m;
  const LaneFloats level = __builtin_convertvector(part_in_layer, LaneFloats);
  const LaneFloats part = near < level ? near : level;
  for (int axis = 0; axis < 3; ++axis) {
    stretches.origin[axis] = end[axis];
    stretches.end[axis] = part < 1 ? end[axis] + part * back[axis] : origin[axis];
  }
}

}  // namespace

void GrazedVoxels::FindStretches(const VoxelGrid& grid, const SurfaceLayers& layers,
                                 const EndingRays& rays, double grazing_m, ThreadPool& pool) {
  stretches_.resize((rays.ends.size() + kRaysTogether - 1) / kRaysTogether);
  const auto find = [&](int, std::size_t begin, std::size_t end) {
    PickedRays picked;
    PickEnding(rays, begin, end, picked);
    KeepInLayers(rays, layers, picked);
    std::vector<Stretch>& found = stretches_[begin / kRaysTogether];
    found.resize(picked.size);
    for (std::size_t k = 0; k < picked.size; k += kLanes) {
      EndingEight eight;
      Gather(rays, picked, k, eight);
      RaySegments stretches;
      FindStretchesOf(eight, grid.resolution_m(), static_cast<float>(grazing_m), stretches);
      const std::size_t count = std::min<std::size_t>(kLanes, picked.size - k);
      for (std::size_t lane = 0; lane < count; ++lane) {
        found[k + lane] = {SegmentIn(stretches, static_cast<int>(lane)),
                           rays.sectors[picked.rays[k + lane]]};
      }
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
