// Voxels in a row that lie in one block.
#pragma once

#include <cstddef>
#include <cstdint>

#include "clearway/map/voxel_block.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// How many values more than there are voxels each output must have room for.
inline constexpr std::size_t kRunsRoom = 8;

// Says of `count` keys where their voxels lie: indices[i] is the place of keys[i] in its block, and
// runs[i] the run, from 0 on, of voxels in one block that it belongs to; firsts[r] is the first
// voxel of run r. Returns how many runs there are.
using CutRuns = std::size_t (*)(const VoxelKey* keys, std::size_t count, std::uint32_t* indices,
                                std::uint32_t* runs, std::uint32_t* firsts);

// The states of those voxels, where blocks[r] is the block of run r; none may be null.
using ReadRuns = void (*)(const VoxelBlock* const* blocks, const std::uint32_t* firsts,
                          std::size_t run_count, const std::uint32_t* indices, std::size_t count,
                          VoxelState* states);

struct RunKernels {
  CutRuns cut;
  ReadRuns read;
};
RunKernels PortableRunKernels();
// Eight voxels at a time. Only for processors of which HasAvx512() is true.
RunKernels Avx512RunKernels();
// The fastest ones for this processor.
RunKernels FastestRunKernels();

}  // namespace clearway
