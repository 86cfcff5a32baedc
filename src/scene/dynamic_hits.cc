#include "scene/dynamic_hits.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "absl/container/flat_hash_map.h"

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

// The bits of eight from the first to the last.
std::uint64_t Ones(std::int32_t first, std::int32_t last) {
  return (std::uint64_t{2} << last) - (std::uint64_t{1} << first);
}

// Counts down for each bit that is set among the voxels of the block from `min` to `max`, some of
// which are in it; to 0 and no further.
void CountDown(BlockKey key, const BlockMask& mask, VoxelKey min, VoxelKey max, int& left) {
  constexpr std::int32_t kLast = kBlockSize - 1;
  const auto [x, y, z] = VoxelAt(key, 0);
  const std::uint64_t row = Ones(std::max(min.x - x, 0), std::min(max.x - x, kLast));
  std::uint64_t layer = 0;
  for (int j = std::max(min.y - y, 0); j <= std::min(max.y - y, kLast); ++j) {
    layer |= row << kBlockSize * j;
  }
  for (int k = std::max(min.z - z, 0); k <= std::min(max.z - z, kLast); ++k) {
    for (std::uint64_t bits = mask.words[k] & layer; bits != 0; bits &= bits - 1) {
      if (--left == 0) return;
    }
  }
}

// Whether so many bits are set at most two voxels away along each axis, the voxel's own too.
// mask_of(key) is a block's mask, or null.
template <class MaskOf>
bool AreAround(VoxelKey key, int fewest, MaskOf&& mask_of) {
  constexpr std::int32_t kReach = 2;
  const VoxelKey min{key.x - kReach, key.y - kReach, key.z - kReach};
  const VoxelKey max{key.x + kReach, key.y + kReach, key.z + kReach};
  const BlockKey first = BlockOf(min), last = BlockOf(max);
  const BlockKey own = BlockOf(key);  // first: most often that settles it
  int left = fewest;
  const auto are_with = [&](BlockKey block) {
    if (const BlockMask* mask = mask_of(block)) CountDown(block, *mask, min, max, left);
    return left == 0;
  };
  if (are_with(own)) return true;
  for (BlockKey block = first; block.z <= last.z; ++block.z) {
    for (block.y = first.y; block.y <= last.y; ++block.y) {
      for (block.x = first.x; block.x <= last.x; ++block.x) {
        if (block != own && are_with(block)) return true;
      }
    }
  }
  return false;
}

// By blocks.
using Voxels = absl::flat_hash_map<BlockKey, BlockMask>;

// A block's hits on voxels that are free.
struct FreeHits {
  BlockKey key;
  const VoxelBlock* block;
  BlockMask hits;
};

// Those in some of the update's blocks.
std::vector<FreeHits> HitsOnFree(const VoxelMap& map, const ScanUpdate& update,
                                 std::span<const std::size_t> places) {
  std::vector<BlockKey> keys;
  for (const std::size_t place : places) keys.push_back(update.keys()[place]);
  std::vector<const VoxelBlock*> blocks(keys.size());
  map.blocks().FindAll(keys, blocks.data());
  std::vector<FreeHits> found;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (blocks[i] == nullptr) continue;
    BlockMask hits = update.block(places[i]).hit;
    hits &= blocks[i]->observed;
    hits.Subtract(blocks[i]->occupied);
    if (hits.Any()) found.push_back({keys[i], blocks[i], hits});
  }
  return found;
}

// The hits on voxels that are as free as the map can know them to be.
Voxels HitsOnFreest(const VoxelMap& map, const ScanUpdate& update) {
  constexpr std::size_t kTogether = 128;  // blocks whose memory is waited for at once
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    if (update.block(i).hit.Any()) places.push_back(i);
  }
  Voxels freest;
  for (std::size_t begin = 0; begin < places.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, places.size() - begin);
    std::vector<FreeHits> found = HitsOnFree(map, update, std::span(places).subspan(begin, count));
    for (const auto& [key, block, hits] : found) {
      hits.ForEach([&, of = block](int i) { __builtin_prefetch(&of->log_odds[i]); });
    }
    for (auto& [key, block, hits] : found) {
      const BlockMask free = hits;
      free.ForEach([&, of = block, &kept = hits](int i) {
        if (of->log_odds[i] != map.model().clamp_min) kept.Clear(i);
      });
      if (hits.Any()) freest.emplace(key, hits);
    }
  }
  return freest;
}

bool IsBesideSurface(const VoxelMap& map, VoxelKey key) {
  return AreAround(key, 1, [&](BlockKey block_key) {
    const VoxelBlock* block = map.blocks().Find(block_key);
    return block == nullptr ? nullptr : &block->occupied;
  });
}

// Whether there are a few more nearby.
bool HasCompany(const Voxels& voxels, VoxelKey key) {
  constexpr int kFewest = 3;  // itself too
  return AreAround(key, kFewest, [&](BlockKey block_key) {
    const auto block = voxels.find(block_key);
    return block == voxels.end() ? nullptr : &block->second;
  });
}

bool IsPassed(const ScanUpdate& update, VoxelKey key) {
  const ScanUpdate::Block* block = update.Find(BlockOf(key));
  const int index = IndexInBlock(key);
  return block != nullptr && block->free.Test(index) && !block->end.Test(index);
}

// The hits that dynamic space explains, in its order: what is in it already, and what may be new.
std::vector<VoxelKey> DynamicHits(const VoxelMap& lasting_W, const DynamicSpace& dynamic_W,
                                  const ScanUpdate& update) {
  const Voxels on_freest = HitsOnFreest(lasting_W, update);
  std::vector<VoxelKey> hits;
  for (const auto& [block, mask] : on_freest) {
    mask.ForEach([&, key = block](int index) {
      const VoxelKey voxel = VoxelAt(key, index);
      if (dynamic_W.Find(voxel) != nullptr ||
          (HasCompany(on_freest, voxel) && !IsBesideSurface(lasting_W, voxel))) {
        hits.push_back(voxel);
      }
    });
  }
  std::ranges::sort(hits, ComesBefore);
  return hits;
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
  const std::vector<VoxelKey> hits = DynamicHits(lasting_W, dynamic_W, update);
  for (const VoxelKey key : hits) {
    update.TakeHit(key);
    const DynamicVoxel* before = dynamic_W.Find(key);
    const bool goes_on = before != nullptr && stamp - before->last_hit <= longest_gap;
    const DynamicVoxel voxel{key, goes_on ? before->first_hit : stamp, stamp};
    if (stamp - voxel.first_hit >= params.dynamic_settle) {
      change.settled.push_back(key);
    } else {
      change.voxels.push_back(voxel);
    }
  }
  const auto first_old = static_cast<std::ptrdiff_t>(change.voxels.size());
  for (const DynamicVoxel& voxel : dynamic_W.voxels()) {
    const bool is_forgotten = lasting_W.Find(voxel.key) != lasting_W.model().clamp_min;
    if (is_forgotten || IsPassed(update, voxel.key) ||
        std::ranges::binary_search(hits, voxel.key, ComesBefore)) {
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
