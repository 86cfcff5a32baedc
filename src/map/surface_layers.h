// Which way the surfaces face that a scan's rays end on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "clearway/base/thread_pool.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// Knows of each voxel that a scan's rays end in, along which axes it has occupied neighbours. Const
// methods may run on any number of threads.
class SurfaceLayers {
 public:
  // Of the map before the scan's update.
  SurfaceLayers(const VoxelMap& map, const ScanUpdate& update, ThreadPool& pool);

  // The axes (bits 0 to 2) along which the voxel has no occupied neighbour: a surface there may lie
  // across them. A ray of the scan must end in the voxel; `place`: of its block in the update.
  unsigned AxesAcross(std::size_t place, VoxelKey voxel) const {
    const int at = IndexInBlock(voxel);
    const auto& beside = blocks_[blocks_by_place_[place]][at >> 6];
    unsigned axes = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      axes |= static_cast<unsigned>(~beside[axis] >> (at & 63) & 1) << axis;
    }
    return axes;
  }

 private:
  // Of a block's layers along z, the voxels that have an occupied neighbour along x, y and z; true
  // of those that rays end in.
  using Beside = std::array<std::array<std::uint64_t, 3>, kBlockSize>;

  std::vector<std::uint32_t> blocks_by_place_;
  std::vector<Beside> blocks_;  // those in which rays end
};

}  // namespace clearway
