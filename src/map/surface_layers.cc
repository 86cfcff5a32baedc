#include "map/surface_layers.h"

#include <algorithm>
#include <span>

namespace clearway {
namespace {

// A block and the six that it shares a face with, in the order of `Around`.
constexpr std::size_t kBlocks = 7;
enum Place { kItself, kBelowX, kAboveX, kBelowY, kAboveY, kBelowZ, kAboveZ };

std::array<BlockKey, kBlocks> Around(BlockKey key) {
  const auto [x, y, z] = key;
  return {{{x, y, z},
           {x - 1, y, z},
           {x + 1, y, z},
           {x, y - 1, z},
           {x, y + 1, z},
           {x, y, z - 1},
           {x, y, z + 1}}};
}

// Masks of the occupied voxels in those blocks; of one that does not exist, none.
using OccupiedAround = std::array<const BlockMask*, kBlocks>;

OccupiedAround OccupiedIn(const VoxelBlock* const* blocks) {
  static constexpr BlockMask kNone{};
  OccupiedAround occupied;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    occupied[i] = blocks[i] == nullptr ? &kNone : &blocks[i]->occupied;
  }
  return occupied;
}

constexpr std::uint64_t kFirstX = 0x0101010101010101, kLastX = kFirstX << 7;

std::uint64_t BesideAlongX(std::uint64_t word, std::uint64_t below, std::uint64_t above) {
  return (word & ~kLastX) << 1 | (word & ~kFirstX) >> 1 | (below & kLastX) >> 7 |
         (above & kFirstX) << 7;
}

std::uint64_t BesideAlongY(std::uint64_t word, std::uint64_t below, std::uint64_t above) {
  return word << 8 | word >> 8 | below >> 56 | above << 56;
}

void FindBeside(const OccupiedAround& occupied,
                std::array<std::array<std::uint64_t, 3>, kBlockSize>& beside) {
  const auto word = [&](Place place, int z) { return occupied[place]->words[z]; };
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t own = word(kItself, z);
    beside[z] = {BesideAlongX(own, word(kBelowX, z), word(kAboveX, z)),
                 BesideAlongY(own, word(kBelowY, z), word(kAboveY, z)),
                 (z > 0 ? word(kItself, z - 1) : word(kBelowZ, 7)) |
                     (z < 7 ? word(kItself, z + 1) : word(kAboveZ, 0))};
  }
}

}  // namespace

SurfaceLayers::SurfaceLayers(const VoxelMap& map, const ScanUpdate& update, ThreadPool& pool)
    : blocks_by_place_(update.keys().size()) {
  std::vector<BlockKey> keys;
  for (std::size_t place = 0; place < update.keys().size(); ++place) {
    if (!update.block(place).end.Any()) continue;
    blocks_by_place_[place] = static_cast<std::uint32_t>(keys.size());
    keys.push_back(update.keys()[place]);
  }
  blocks_.resize(keys.size());
  constexpr std::size_t kTogether = 32;  // blocks whose memory is waited for at once
  pool.ParallelChunks(keys.size(), kTogether, [&](int, std::size_t begin, std::size_t end) {
    std::array<BlockKey, kTogether * kBlocks> around;
    std::array<const VoxelBlock*, kTogether * kBlocks> found;
    for (std::size_t i = begin; i < end; ++i) {
      std::ranges::copy(Around(keys[i]), &around[(i - begin) * kBlocks]);
    }
    map.blocks().FindOccupied(std::span(around).first((end - begin) * kBlocks), found.data());
    for (std::size_t i = begin; i < end; ++i) {
      FindBeside(OccupiedIn(&found[(i - begin) * kBlocks]), blocks_[i]);
    }
  });
}

}  // namespace clearway
