// Points in a row that lie in one block.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "clearway/map/voxel_block.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// For how many points at most a kernel is asked, and how many values more than there are points
// each array must have room for.
inline constexpr std::size_t kRunsAtOnce = 512, kRunsRoom = 32;

// Says of `count` points, as KeyOf, where their voxels lie: indices[i] is the place of that of
// points[i] in its block; firsts[r] is the first point of run r, of points in a row that lie in
// blocks[r], and the end of the run before. Returns how many runs there are. Asks for as many
// points from `soon` on meanwhile.
using CutRuns = std::size_t (*)(const VoxelGrid& grid, const Eigen::Vector3d* points,
                                std::size_t count, const Eigen::Vector3d* soon,
                                std::uint16_t* indices, std::uint32_t* firsts, BlockKey* blocks);

// The memory of these, without waiting for it. Processors do so by themselves for what is read in
// order, but stop at the end of each page.
inline void AskFor(const Eigen::Vector3d* points, std::size_t count) {
  for (std::size_t line = 0; line < count * sizeof(*points); line += 64) {
    __builtin_prefetch(reinterpret_cast<const char*>(points) + line);
  }
}

// The states of those voxels, where blocks[r] is the block of run r; none may be null.
using ReadRuns = void (*)(const VoxelBlock* const* blocks, const std::uint32_t* firsts,
                          std::size_t run_count, const std::uint16_t* indices, VoxelState* states);

struct RunKernels {
  CutRuns cut;
  ReadRuns read;
};
RunKernels PortableRunKernels();
// Eight points at a time and more. Only for processors of which HasAvx512() is true.
RunKernels Avx512RunKernels();
// The fastest ones for this processor.
RunKernels FastestRunKernels();

}  // namespace clearway
