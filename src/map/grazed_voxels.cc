#include "map/grazed_voxels.h"

#include <optional>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/ray.h"

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

// The axes (bits 0 to 2) along which two voxels are in one layer.
unsigned SharedAxes(VoxelKey a, VoxelKey b) {
  return static_cast<unsigned>(a.x == b.x) | static_cast<unsigned>(a.y == b.y) << 1 |
         static_cast<unsigned>(a.z == b.z) << 2;
}

// Goes rays back from their ends. One thread.
class GrazeFinder {
 public:
  GrazeFinder(const VoxelMap& map, const MaskByBlock& missed, double grazing_m)
      : map_(map), missed_(missed), grazing_m_(grazing_m) {}

  // Adds those of the missed voxels that the ray grazes.
  void Find(const RaySegment& ray, std::vector<VoxelKey>& grazed) {
    const VoxelGrid& grid = map_.grid();
    const Eigen::Vector3f back = ray.origin - ray.end;
    const double length_m = back.norm();
    const bool whole = length_m <= grazing_m_;
    const Eigen::Vector3f until =
        whole ? ray.origin : ray.end + static_cast<float>(grazing_m_ / length_m) * back;
    const VoxelKey end = grid.KeyOf(ray.end.cast<double>());
    std::optional<unsigned> across;  // once it is wanted
    WalkRayWhile(grid, ray.end, until, [&](VoxelKey key) {
      const unsigned shared = SharedAxes(key, end);
      if (shared == 0) return false;
      if (!IsMissed(key)) return true;
      if (!across) across = AxesAcross(end);
      if ((shared & *across) != 0) grazed.push_back(key);
      return *across != 0;
    });
  }

 private:
  // The axes along which the voxel has no occupied neighbour: a surface there may lie across them.
  unsigned AxesAcross(VoxelKey key) const {
    const auto occupied = [&](int x, int y, int z) {
      return map_.State({key.x + x, key.y + y, key.z + z}) == VoxelState::kOccupied;
    };
    return static_cast<unsigned>(!occupied(1, 0, 0) && !occupied(-1, 0, 0)) |
           static_cast<unsigned>(!occupied(0, 1, 0) && !occupied(0, -1, 0)) << 1 |
           static_cast<unsigned>(!occupied(0, 0, 1) && !occupied(0, 0, -1)) << 2;
  }
  bool IsMissed(VoxelKey key) {
    const BlockKey block = BlockOf(key);
    if (mask_ == nullptr || block != block_) {
      static constexpr BlockMask kNone{};
      const auto found = missed_.find(block);
      block_ = block;
      mask_ = found == missed_.end() ? &kNone : &found->second;
    }
    return mask_->Test(IndexInBlock(key));
  }

  const VoxelMap& map_;
  const MaskByBlock& missed_;
  double grazing_m_;
  // Rays stay in one block for several steps.
  BlockKey block_;
  const BlockMask* mask_ = nullptr;
};

}  // namespace

void SpareGrazed(const VoxelMap& map, std::span<const RaySegment> rays, double grazing_m,
                 ThreadPool& pool, ScanUpdate& update) {
  const MaskByBlock missed = MissedOccupied(map, update);
  if (missed.empty()) return;
  std::vector<std::vector<VoxelKey>> grazed(pool.threads());
  pool.ParallelFor(rays.size(), [&](int worker, std::size_t begin, std::size_t end) {
    GrazeFinder finder(map, missed, grazing_m);
    for (std::size_t i = begin; i < end; ++i) finder.Find(rays[i], grazed[worker]);
  });
  for (const std::vector<VoxelKey>& keys : grazed) {
    for (const VoxelKey key : keys) update.MarkEnd(key);
  }
}

}  // namespace clearway
