#include "map/voxel_runs.h"

#include "map/avx512.h"

namespace clearway {
namespace {

std::size_t Cut(const VoxelKey* keys, std::size_t count, std::uint32_t* indices,
                std::uint32_t* runs, std::uint32_t* firsts) {
  if (count == 0) return 0;
  std::uint32_t run = 0;
  BlockKey block = BlockOf(keys[0]);
  firsts[0] = 0;
  for (std::size_t i = 0; i < count; ++i) {  // without a branch
    const BlockKey next = BlockOf(keys[i]);
    const bool begins = ((next.x ^ block.x) | (next.y ^ block.y) | (next.z ^ block.z)) != 0;
    block = next;
    firsts[run + 1] = static_cast<std::uint32_t>(i);
    run += begins;
    runs[i] = run;
    indices[i] = static_cast<std::uint32_t>(IndexInBlock(keys[i]));
  }
  return run + 1;
}

// Without a branch.
VoxelState StateOf(const VoxelBlock& block, int index) {
  static_assert(static_cast<int>(VoxelState::kFree) == 1);
  static_assert(static_cast<int>(VoxelState::kOccupied) == 2);
  return static_cast<VoxelState>(block.observed.Test(index) + block.occupied.Test(index));
}

void Read(const VoxelBlock* const* blocks, const std::uint32_t* firsts, std::size_t run_count,
          const std::uint32_t* indices, std::size_t count, VoxelState* states) {
  for (std::size_t r = 0; r < run_count; ++r) {
    const std::size_t end = r + 1 < run_count ? firsts[r + 1] : count;
    for (std::size_t i = firsts[r]; i < end; ++i) {
      states[i] = StateOf(*blocks[r], static_cast<int>(indices[i]));
    }
  }
}

}  // namespace

RunKernels PortableRunKernels() { return {Cut, Read}; }
RunKernels FastestRunKernels() { return HasAvx512() ? Avx512RunKernels() : PortableRunKernels(); }

}  // namespace clearway
