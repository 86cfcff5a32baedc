#include "clearway/map/voxel_map.h"

#include <algorithm>

#include "map/block_update.h"

namespace clearway {
namespace {

constexpr VoxelBlock kEmptyBlock{};

// Most often nothing has to be counted.
int Growth(const BlockMask& before, const BlockMask& after) {
  return before == after ? 0 : after.Count() - before.Count();
}

template <class MaskOf>
Aabb BoxAround(const VoxelMap& map, MaskOf mask_of) {
  Aabb box;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    mask_of(block).ForEach([&](int index) { box.Extend(map.grid().BoxOf(VoxelAt(key, index))); });
  });
  return box;
}

}  // namespace

VoxelState VoxelMap::State(VoxelKey key) const {
  const VoxelBlock* block = blocks_.Find(BlockOf(key));
  return block == nullptr ? VoxelState::kUnknown : block->State(IndexInBlock(key));
}

std::optional<LogOdds> VoxelMap::Find(VoxelKey key) const {
  const VoxelBlock* block = blocks_.Find(BlockOf(key));
  const int index = IndexInBlock(key);
  if (block == nullptr || !block->observed.Test(index)) return std::nullopt;
  return block->log_odds[index];
}

void VoxelMap::PutBlock(BlockKey key, const VoxelBlock& block) {
  const VoxelBlock* before = blocks_.Find(key);
  if (before == nullptr) before = &kEmptyBlock;
  if (*before == block) return;
  observed_count_ += Growth(before->observed, block.observed);
  occupied_count_ += Growth(before->occupied, block.occupied);
  blocks_.Put(key, block);
}

void VoxelMap::Update(const ScanUpdate& update, ThreadPool& pool) {
  struct alignas(64) Counts {  // a thread's own cache line
    std::int64_t observed = 0, occupied = 0;
  };
  std::vector<Counts> growth(pool.threads());
  blocks_.PutAll(update.keys(), pool,
                 [&](int worker, std::size_t i, const VoxelBlock& before, VoxelBlock& after) {
                   if (!ApplyScan(update.block(i), model_, before, after)) return false;
                   growth[worker].observed += Growth(before.observed, after.observed);
                   growth[worker].occupied += Growth(before.occupied, after.occupied);
                   return true;
                 });
  for (const Counts& part : growth) {
    observed_count_ += part.observed;
    occupied_count_ += part.occupied;
  }
}

void VoxelMap::Set(VoxelKey key, LogOdds value) {
  const VoxelBlock* before = blocks_.Find(BlockOf(key));
  VoxelBlock block = before == nullptr ? kEmptyBlock : *before;
  block.Set(IndexInBlock(key), std::clamp(value, model_.clamp_min, model_.clamp_max), model_);
  PutBlock(BlockOf(key), block);
}

std::int64_t VoxelMap::Forget(const Aabb& box) {
  const VoxelRange range = grid_.CentersIn(box);
  if (range.count() == 0) return 0;
  std::vector<std::pair<BlockKey, VoxelBlock>> changed;
  blocks_.ForEachIn(BlockOf(range.first), BlockOf(range.last),
                    [&](BlockKey key, const VoxelBlock& before) {
                      VoxelBlock block = before;
                      before.observed.ForEach([&](int index) {
                        if (range.Contains(VoxelAt(key, index))) block.Forget(index);
                      });
                      if (block != before) changed.emplace_back(key, block);
                    });
  const std::int64_t observed = observed_count_;
  for (const auto& [key, block] : changed) PutBlock(key, block);
  return observed - observed_count_;
}

void VoxelMap::ForgetBlocksOutside(const Aabb& box) {
  const double limit_m = grid_.limit_m();
  const auto block_at = [&](const Eigen::Vector3d& p) {
    return BlockOf(grid_.KeyOf(p.cwiseMax(-limit_m).cwiseMin(limit_m)));
  };
  for (const BlockKey key : blocks_.KeysOutside(block_at(box.min), block_at(box.max))) {
    PutBlock(key, kEmptyBlock);
  }
}

Aabb VoxelMap::ObservedBox() const {
  return BoxAround(*this, [](const VoxelBlock& b) -> const BlockMask& { return b.observed; });
}

Aabb VoxelMap::OccupiedBox() const {
  return BoxAround(*this, [](const VoxelBlock& b) -> const BlockMask& { return b.occupied; });
}

bool operator==(const VoxelMap& a, const VoxelMap& b) {
  if (!(a.grid() == b.grid()) || !(a.model() == b.model())) return false;
  bool equal = true;
  BlockTree::ForEachDifference(a.blocks(), b.blocks(),
                               [&](BlockKey, const VoxelBlock* x, const VoxelBlock* y) {
                                 equal = equal && x != nullptr && y != nullptr && *x == *y;
                               });
  return equal;
}

}  // namespace clearway
