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

constexpr std::uint64_t kFirstX = 0x0101010101010101, kLastX = kFirstX << 7;
constexpr std::uint64_t kFirstY = 0xff, kLastY = kFirstY << 56;

// Which of those blocks tell something about some of the block's voxels: bit i is that of place i.
unsigned NeededFor(const BlockMask& voxels) {
  std::uint64_t columns = 0;
  for (const std::uint64_t layer : voxels.words) columns |= layer;
  const auto if_any = [](std::uint64_t bits, Place place) { return unsigned{bits != 0} << place; };
  return 1U << kItself | if_any(columns & kFirstX, kBelowX) | if_any(columns & kLastX, kAboveX) |
         if_any(columns & kFirstY, kBelowY) | if_any(columns & kLastY, kAboveY) |
         if_any(voxels.words.front(), kBelowZ) | if_any(voxels.words.back(), kAboveZ);
}

// Masks of the occupied voxels in those blocks; of one that does not exist, none.
using OccupiedAround = std::array<const BlockMask*, kBlocks>;

// A few blocks, and those of their neighbours that tell something: their memory is waited for at
// once.
class Neighbourhoods {
 public:
  static constexpr std::size_t kMost = 32;

  void Add(BlockKey key, const BlockMask& voxels) {
    const unsigned needed = NeededFor(voxels);
    const std::array<BlockKey, kBlocks> around = Around(key);
    for (unsigned place = 0; place < kBlocks; ++place) {
      keys_[count_] = around[place];
      slots_[count_] = size_ * kBlocks + place;
      count_ += needed >> place & 1;
    }
    ++size_;
  }
  void FindIn(const VoxelMap& map) {
    std::array<const VoxelBlock*, kMost * kBlocks> found;
    map.blocks().FindOccupied(std::span(keys_).first(count_), found.data());
    for (std::size_t i = 0; i < count_; ++i) {
      if (found[i] != nullptr) occupied_[slots_[i]] = &found[i]->occupied;
    }
  }
  // Of the i-th that was added.
  OccupiedAround Occupied(std::size_t i) const {
    OccupiedAround occupied;
    std::copy_n(&occupied_[i * kBlocks], kBlocks, occupied.begin());
    return occupied;
  }

 private:
  static constexpr BlockMask kNone{};
  static std::array<const BlockMask*, kMost * kBlocks> AllNone() {
    std::array<const BlockMask*, kMost * kBlocks> none;
    none.fill(&kNone);
    return none;
  }

  std::size_t size_ = 0, count_ = 0;
  std::array<BlockKey, kMost * kBlocks + 1> keys_;  // one more: written, and perhaps not kept
  std::array<std::size_t, kMost * kBlocks + 1> slots_;
  std::array<const BlockMask*, kMost* kBlocks> occupied_ = AllNone();
};

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
  const std::vector<std::size_t>& places = update.end_places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    blocks_by_place_[places[i]] = static_cast<std::uint32_t>(i);
  }
  blocks_.resize(places.size());
  const auto find = [&](int, std::size_t begin, std::size_t end) {
    Neighbourhoods around;
    for (std::size_t i = begin; i < end; ++i) {
      around.Add(update.keys()[places[i]], update.block(places[i]).end);
    }
    around.FindIn(map);
    for (std::size_t i = begin; i < end; ++i) FindBeside(around.Occupied(i - begin), blocks_[i]);
  };
  pool.ParallelChunks(places.size(), Neighbourhoods::kMost, find);
}

}  // namespace clearway
