// Which way the surfaces face that a scan's rays end on.
#pragma once

#include <array>
#include <vector>

#include "absl/container/flat_hash_map.h"
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

  // Of a block, the voxels that have an occupied neighbour along x, y and z.
  using Beside = std::array<BlockMask, 3>;
  // A ray of the scan must end in the block.
  const Beside& In(BlockKey block) const { return beside_[index_.find(block)->second]; }

 private:
  absl::flat_hash_map<BlockKey, std::size_t> index_;
  std::vector<Beside> beside_;
};

// The axes (bits 0 to 2) along which the voxel has no occupied neighbour: a surface there may lie
// across them.
inline unsigned AxesAcross(const SurfaceLayers::Beside& beside, VoxelKey voxel) {
  const int at = IndexInBlock(voxel);
  unsigned axes = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    axes |= static_cast<unsigned>(!beside[axis].Test(at)) << axis;
  }
  return axes;
}

}  // namespace clearway
