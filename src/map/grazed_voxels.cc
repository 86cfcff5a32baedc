#include "map/grazed_voxels.h"

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

// Goes rays back from their ends. One thread.
class GrazeFinder {
 public:
  GrazeFinder(const VoxelGrid& grid, const MaskByBlock& missed, double grazing_m)
      : grid_(grid), missed_(missed), grazing_m_(grazing_m) {}

  // Adds those of the missed voxels that the ray grazes.
  void Find(const RaySegment& ray, std::vector<VoxelKey>& grazed) {
    const Eigen::Vector3f back = ray.origin - ray.end;
    const double length_m = back.norm();
    const bool whole = length_m <= grazing_m_;
    const Eigen::Vector3f until =
        whole ? ray.origin : ray.end + static_cast<float>(grazing_m_ / length_m) * back;
    const VoxelKey end = grid_.KeyOf(ray.end.cast<double>());
    WalkRayWhile(grid_, ray.end, until, [&](VoxelKey key) {
      if (key.x != end.x && key.y != end.y && key.z != end.z) return false;
      if (IsMissed(key)) grazed.push_back(key);
      return true;
    });
  }

 private:
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

  const VoxelGrid& grid_;
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
    GrazeFinder finder(map.grid(), missed, grazing_m);
    for (std::size_t i = begin; i < end; ++i) finder.Find(rays[i], grazed[worker]);
  });
  for (const std::vector<VoxelKey>& keys : grazed) {
    for (const VoxelKey key : keys) update.MarkEnd(key);
  }
}

}  // namespace clearway
