#include "map/voxel_runs.h"

#include <array>

#include "map/avx512.h"

namespace clearway {
namespace {

std::size_t Cut(const VoxelGrid& grid, const Eigen::Vector3d* points, std::size_t count,
                const Eigen::Vector3d* soon, std::uint16_t* indices, std::uint32_t* firsts,
                BlockKey* blocks) {
  if (count == 0) return 0;
  AskFor(soon, count);
  std::array<VoxelKey, kRunsAtOnce> keys;
  grid.KeysOf({points, count}, keys.data());
  std::uint32_t run = 0;
  BlockKey block = BlockOf(keys[0]);
  firsts[0] = 0;
  for (std::size_t i = 0; i < count; ++i) {  // without a branch
    const BlockKey next = BlockOf(keys[i]);
    firsts[run + 1] = static_cast<std::uint32_t>(i);
    run += ((next.x ^ block.x) | (next.y ^ block.y) | (next.z ^ block.z)) != 0;
    blocks[run] = block = next;
    indices[i] = static_cast<std::uint16_t>(IndexInBlock(keys[i]));
  }
  firsts[run + 1] = static_cast<std::uint32_t>(count);
  return run + 1;
}

// Without a branch.
VoxelState StateOf(const VoxelBlock& block, int index) {
  static_assert(static_cast<int>(VoxelState::kFree) == 1);
  static_assert(static_cast<int>(VoxelState::kOccupied) == 2);
  return static_cast<VoxelState>(block.observed.Test(index) + block.occupied.Test(index));
}

void Read(const VoxelBlock* const* blocks, const std::uint32_t* firsts, std::size_t run_count,
          const std::uint16_t* indices, VoxelState* states) {
  for (std::size_t r = 0; r < run_count; ++r) {
    for (std::size_t i = firsts[r]; i < firsts[r + 1]; ++i) {
      states[i] = StateOf(*blocks[r], indices[i]);
    }
  }
}

}  // namespace

RunKernels PortableRunKernels() { return {Cut, Read}; }
RunKernels FastestRunKernels() { return HasAvx512() ? Avx512RunKernels() : PortableRunKernels(); }

}  // namespace clearway
