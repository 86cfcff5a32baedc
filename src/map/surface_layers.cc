#include "map/surface_layers.h"

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

std::array<BlockMask, 3> BesideOccupied(const OccupiedAround& occupied) {
  const auto word = [&](Place place, int z) { return occupied[place]->words[z]; };
  std::array<BlockMask, 3> beside;
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t own = word(kItself, z);
    beside[0].words[z] = BesideAlongX(own, word(kBelowX, z), word(kAboveX, z));
    beside[1].words[z] = BesideAlongY(own, word(kBelowY, z), word(kAboveY, z));
    beside[2].words[z] = (z > 0 ? word(kItself, z - 1) : word(kBelowZ, 7)) |
                         (z < 7 ? word(kItself, z + 1) : word(kAboveZ, 0));
  }
  return beside;
}

}  // namespace

SurfaceLayers::SurfaceLayers(const VoxelMap& map, const ScanUpdate& update, ThreadPool& pool) {
  std::vector<BlockKey> keys;  // of each block and those around it in turn
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    if (!update.block(i).end.Any()) continue;
    index_.emplace(update.keys()[i], index_.size());
    for (const BlockKey key : Around(update.keys()[i])) keys.push_back(key);
  }
  std::vector<const VoxelBlock*> blocks(keys.size());
  map.blocks().FindOccupied(keys, blocks.data());
  beside_.resize(index_.size());
  pool.ParallelFor(beside_.size(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      beside_[i] = BesideOccupied(OccupiedIn(&blocks[i * kBlocks]));
    }
  });
}

}  // namespace clearway
