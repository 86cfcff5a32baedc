#include "scene/sudden_hits.h"

#include <algorithm>
#include <span>
#include <utility>

#include "absl/container/flat_hash_map.h"

namespace clearway {
namespace {

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

constexpr std::int32_t kReach = 2;

// Whether so many bits are set at most kReach voxels away along each axis, the voxel's own too.
// mask_of(key) is a block's mask, or null.
template <class MaskOf>
bool AreAround(VoxelKey key, int fewest, MaskOf&& mask_of) {
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

// Of the same block, the voxels that are at most kReach away along each axis from one of the mask.
BlockMask Around(const BlockMask& mask) {
  constexpr std::uint64_t kFirstX = 0x0101010101010101, kFirstTwoX = kFirstX * 3;
  static_assert(kReach == 2);
  BlockMask in_layers;
  for (int z = 0; z < kBlockSize; ++z) {
    const std::uint64_t own = mask.words[z];
    const std::uint64_t row = own | (own & ~(kFirstX << 7)) << 1 | (own & ~(kFirstTwoX << 6)) << 2 |
                              (own & ~kFirstX) >> 1 | (own & ~kFirstTwoX) >> 2;
    in_layers.words[z] = row | row << 8 | row << 16 | row >> 8 | row >> 16;
  }
  BlockMask around;
  for (int z = 0; z < kBlockSize; ++z) {
    for (int k = std::max(z - kReach, 0); k <= std::min(z + kReach, kBlockSize - 1); ++k) {
      around.words[z] |= in_layers.words[k];
    }
  }
  return around;
}

// A block's hits on voxels that are free.
struct FreeHits {
  const VoxelBlock* block;
  BlockMask hits;
};
using FreeHitsByBlock = absl::flat_hash_map<BlockKey, FreeHits>;

// Those in some of the update's blocks.
std::vector<std::pair<BlockKey, FreeHits>> HitsOnFree(const VoxelMap& map, const ScanUpdate& update,
                                                      std::span<const std::size_t> places) {
  std::vector<BlockKey> keys;
  for (const std::size_t place : places) keys.push_back(update.keys()[place]);
  std::vector<const VoxelBlock*> blocks(keys.size());
  map.blocks().FindAll(keys, blocks.data());
  std::vector<std::pair<BlockKey, FreeHits>> found;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (blocks[i] == nullptr) continue;
    BlockMask hits = update.block(places[i]).hit;
    hits &= blocks[i]->observed;
    hits.Subtract(blocks[i]->occupied);
    if (hits.Any()) found.push_back({keys[i], {blocks[i], hits}});
  }
  return found;
}

// The hits on voxels that are as free as the map can know them to be.
FreeHitsByBlock HitsOnFreest(const VoxelMap& map, const ScanUpdate& update) {
  constexpr std::size_t kTogether = 128;  // blocks whose memory is waited for at once
  const std::vector<std::size_t>& places = update.end_places();  // a hit is an end
  FreeHitsByBlock freest;
  for (std::size_t begin = 0; begin < places.size(); begin += kTogether) {
    const std::size_t count = std::min(kTogether, places.size() - begin);
    auto found = HitsOnFree(map, update, std::span(places).subspan(begin, count));
    for (const auto& [key, free] : found) {
      free.hits.ForEach([&, of = free.block](int i) { __builtin_prefetch(&of->log_odds[i]); });
    }
    for (auto& [key, free] : found) {
      BlockMask kept = free.hits;
      free.hits.ForEach([&, of = free.block](int i) {
        if (of->log_odds[i] != map.model().clamp_min) kept.Clear(i);
      });
      if (kept.Any()) freest.emplace(key, FreeHits{free.block, kept});
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
bool HasCompany(const FreeHitsByBlock& voxels, VoxelKey key) {
  constexpr int kFewest = 3;  // itself too
  return AreAround(key, kFewest, [&](BlockKey block_key) {
    const auto block = voxels.find(block_key);
    return block == voxels.end() ? nullptr : &block->second.hits;
  });
}

}  // namespace

std::vector<VoxelKey> SuddenHits(const VoxelMap& lasting_W, const DynamicSpace& dynamic_W,
                                 const ScanUpdate& update) {
  const FreeHitsByBlock on_freest = HitsOnFreest(lasting_W, update);
  std::vector<VoxelKey> hits;
  for (const auto& [block, free] : on_freest) {
    // Most are beside a surface, and most often their block alone tells.
    const BlockMask beside = Around(free.block->occupied);
    free.hits.ForEach([&, key = block](int index) {
      const VoxelKey voxel = VoxelAt(key, index);
      if (dynamic_W.Find(voxel) != nullptr ||
          (!beside.Test(index) && !IsBesideSurface(lasting_W, voxel) &&
           HasCompany(on_freest, voxel))) {
        hits.push_back(voxel);
      }
    });
  }
  std::ranges::sort(hits, ComesBefore);
  return hits;
}

}  // namespace clearway
