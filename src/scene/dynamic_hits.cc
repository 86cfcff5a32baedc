#include "scene/dynamic_hits.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "scene/sudden_hits.h"

namespace clearway {
namespace {

// Of a voxel that is dynamic: as after a hit on what could be either.
LogOdds DynamicLogOdds(const OccupancyModel& model) { return model.AfterHit(model.occupied); }

// Sets the voxels, in DynamicSpace's order, to the value, or makes them unknown.
template <class Voxels, class KeyOf>
void SetAll(const Voxels& voxels, KeyOf key_of, std::optional<LogOdds> value, VoxelMap& map) {
  for (auto next = voxels.begin(); next != voxels.end();) {
    const BlockKey key = BlockOf(key_of(*next));
    const VoxelBlock* before = map.blocks().Find(key);
    VoxelBlock block = before == nullptr ? VoxelBlock{} : *before;
    for (; next != voxels.end() && BlockOf(key_of(*next)) == key; ++next) {
      const int index = IndexInBlock(key_of(*next));
      value ? block.Set(index, *value, map.model()) : block.Forget(index);
    }
    map.PutBlock(key, block);
  }
}

VoxelKey KeyOf(const DynamicVoxel& voxel) { return voxel.key; }

bool IsPassed(const ScanUpdate& update, VoxelKey key) {
  const ScanUpdate::Block* block = update.Find(BlockOf(key));
  const int index = IndexInBlock(key);
  return block != nullptr && block->free.Test(index) && !block->end.Test(index);
}

}  // namespace

VoxelMap WithoutDynamic(VoxelMap static_map_W, const DynamicSpace& dynamic_W) {
  SetAll(dynamic_W.voxels(), KeyOf, static_map_W.model().clamp_min, static_map_W);
  return static_map_W;
}

DynamicChange TakeDynamicHits(const VoxelMap& lasting_W, const DynamicSpace& dynamic_W, Time stamp,
                              const SceneParams& params, ScanUpdate& update) {
  DynamicChange change;
  const Duration longest_gap = params.dynamic_settle / 4;
  const std::vector<VoxelKey> hits = SuddenHits(lasting_W, dynamic_W, update);
  for (const VoxelKey key : hits) {
    update.TakeHit(key);
    const DynamicVoxel* before = dynamic_W.Find(key);
    const bool goes_on = before != nullptr && stamp - before->last_hit <= longest_gap;
    const Time last_hit = goes_on ? std::max(before->last_hit, stamp) : stamp;  // of a late frame
    const DynamicVoxel voxel{key, goes_on ? before->first_hit : stamp, last_hit};
    if (last_hit - voxel.first_hit >= params.dynamic_settle) {
      change.settled.push_back(key);
    } else {
      change.voxels.push_back(voxel);
    }
  }
  const auto first_old = static_cast<std::ptrdiff_t>(change.voxels.size());
  for (const DynamicVoxel& voxel : dynamic_W.voxels()) {
    const bool is_forgotten = lasting_W.Find(voxel.key) != lasting_W.model().clamp_min;
    // A ray of a late frame says nothing about a hit that came after it.
    const bool is_passed = voxel.last_hit <= stamp && IsPassed(update, voxel.key);
    if (is_forgotten || is_passed || std::ranges::binary_search(hits, voxel.key, ComesBefore)) {
      continue;
    }
    if (stamp - voxel.last_hit > params.dynamic_life) {
      change.lost.push_back(voxel.key);
    } else {
      change.voxels.push_back(voxel);
    }
  }
  std::ranges::inplace_merge(change.voxels, change.voxels.begin() + first_old, ComesBefore, KeyOf);
  return change;
}

DynamicSpace PutDynamic(DynamicChange change, VoxelMap& static_map_W) {
  const LogOdds occupied = DynamicLogOdds(static_map_W.model());
  SetAll(change.voxels, KeyOf, occupied, static_map_W);
  SetAll(change.settled, std::identity(), occupied, static_map_W);
  SetAll(change.lost, std::identity(), std::nullopt, static_map_W);
  return DynamicSpace(std::move(change.voxels));
}

DynamicSpace WithoutObserved(const DynamicSpace& dynamic_W, const VoxelMap& map_W) {
  std::vector<DynamicVoxel> left(dynamic_W.voxels().begin(), dynamic_W.voxels().end());
  std::erase_if(left, [&](const DynamicVoxel& v) { return map_W.Find(v.key).has_value(); });
  return DynamicSpace(std::move(left));
}

DynamicSpace StillIn(const VoxelMap& static_map_W, const DynamicSpace& dynamic_W) {
  const LogOdds occupied = DynamicLogOdds(static_map_W.model());
  std::vector<DynamicVoxel> still(dynamic_W.voxels().begin(), dynamic_W.voxels().end());
  const std::size_t gone = std::erase_if(
      still, [&](const DynamicVoxel& v) { return static_map_W.Find(v.key) != occupied; });
  return gone == 0 ? dynamic_W : DynamicSpace(std::move(still));
}

}  // namespace clearway
