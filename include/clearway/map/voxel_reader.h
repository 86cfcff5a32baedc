// Many lookups in one map.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "clearway/map/voxel_map.h"

namespace clearway {

// Looks up many points at once, which is several times as fast as one after the other: a block is
// searched for once for the points in a row that lie in it, and memory is waited for once for many
// points. Refers to the map, which must not be written to meanwhile. One thread; keep a reader, for
// it keeps its memory.
class VoxelReader {
 public:
  explicit VoxelReader(const VoxelMap& map);

  // states[i] is the state of the voxel that holds points[i], in the map's frame; each |coordinate|
  // must be at most grid().limit_m(). The spans are of one size.
  void States(std::span<const Eigen::Vector3d> points, std::span<VoxelState> states);

  // Calls visit(i, block, index) for each point: its voxel is the block's one at that index; an
  // empty block stands for one that does not exist.
  template <class Visit>
  void ForEach(std::span<const Eigen::Vector3d> points, Visit&& visit) {
    for (std::size_t begin = 0; begin < points.size(); begin += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, points.size() - begin);
      const std::size_t runs = Locate(points, begin, count);
      for (std::size_t r = 0; r < runs; ++r) {
        for (std::size_t i = firsts_[r]; i < firsts_[r + 1]; ++i) {
          visit(begin + i, *blocks_[r], static_cast<int>(indices_[i]));
        }
      }
    }
  }

 private:
  // Points: all that is known of so many stays in the first cache.
  static constexpr std::size_t kAtOnce = 512;

  // Fills what follows for `count` points from `begin` on, at most kAtOnce; returns how many runs
  // there are.
  std::size_t Locate(std::span<const Eigen::Vector3d> points, std::size_t begin, std::size_t count);

  const VoxelMap& map_;
  // Of each point: its voxel's place in its block, and for States its state.
  std::vector<std::uint16_t> indices_;
  std::vector<VoxelState> states_;
  // Of each run of points in one block: its first point and, beyond the last, the end; the block.
  std::vector<std::uint32_t> firsts_;
  std::vector<BlockKey> block_keys_;
  std::vector<const VoxelBlock*> blocks_;
};

}  // namespace clearway
