// Which of a few voxels rays pass.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "clearway/base/thread_pool.h"
#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"
#include "map/ray_sector.h"

namespace clearway {

// Of all that rays pass, gathers only what lies in some blocks: faster than to gather everything.
// Keeps its memory from one search to the next. One thread at a time.
class PassedVoxels {
 public:
  void Clear();
  // `sector`: one of RaySector::kCount. Which one changes nothing but the time it takes: the least
  // if the rays of one lie near each other.
  void Add(const RaySegment& ray, int sector) { sectors_[sector].rays.Add(ray); }
  // Of each candidate, no block twice, the voxels that a ray visits as WalkRay does. Once after the
  // rays were added. The result does not depend on the number of threads.
  std::vector<BlockMask> Among(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid,
                               ThreadPool& pool);

 private:
  // The rays of one sector.
  struct Sector {
    RayRounds rays;
    BitWindow window;  // of its bits, those of candidates alone tell anything
    struct Passed {
      std::size_t candidate;
      BlockMask mask;
    };
    std::vector<Passed> passed;

    void Find(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid);
    void FindIn(BlockKey first, BlockKey last, std::span<const BitWindow::Block> candidates,
                const VoxelGrid& grid);
    void FindSparsely(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid);
  };
  std::array<Sector, RaySector::kCount> sectors_;
};

}  // namespace clearway
