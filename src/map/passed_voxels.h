// Which of a few voxels rays pass.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
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
  void Add(const RaySegment& ray, int sector) { sectors_[sector].Add(ray); }
  // Of each candidate, no block twice, the voxels that a ray visits as WalkRay does. Once after the
  // rays were added. The result does not depend on the number of threads.
  std::vector<BlockMask> Among(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid,
                               ThreadPool& pool);

 private:
  // The rays of one sector.
  struct Sector {
    static constexpr int kLengths = 8;
    std::array<RayEights, kLengths> rays;  // by length: those walked together are about as long
    BitWindow window;                      // of its bits, those of candidates alone tell anything
    struct Passed {
      std::size_t candidate;
      BlockMask mask;
    };
    std::vector<Passed> passed;

    void Clear();
    void Add(const RaySegment& ray);
    void Find(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid);
    void FindIn(BlockKey first, BlockKey last, std::span<const BitWindow::Block> candidates,
                const VoxelGrid& grid);
    void FindSparsely(std::span<const BitWindow::Block> candidates, const VoxelGrid& grid);
  };
  std::array<Sector, RaySector::kCount> sectors_;
};

// Implementation.

inline void PassedVoxels::Sector::Add(const RaySegment& ray) {
  constexpr int kShortest = -3;  // the power of two, in metres
  const float steps_m = (ray.end - ray.origin).cwiseAbs().sum();
  const auto power = static_cast<int>(std::bit_cast<std::uint32_t>(steps_m) >> 23) - 127;
  rays[std::clamp(power - kShortest, 0, kLengths - 1)].Add(ray);
}

}  // namespace clearway
