// Voxels whose centre lies in a shape.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/cube_contact.h"
#include "collision/sweep.h"
#include "collision/voxel_search.h"

namespace clearway {

// Tells of the centres of voxels whether a shape may hold them somewhere on its way, and whether it
// surely does all along, if no point of it ever is farther than the sweep's largest margin from
// where the way puts it. In W. Of a box a row of voxels along x is told at once. Refers to the
// sweep.
class CenterMasks {
 public:
  CenterMasks(const VoxelGrid& grid, const Sweep& sweep);

  bool Empty() const { return !keys_; }
  // The blocks outside this range hold none; not to be called if it is empty.
  BlockKey first() const { return BlockOf(keys_->min); }
  BlockKey last() const { return BlockOf(keys_->max); }
  bool Near(BlockKey block) const;

  struct Masks {
    BlockMask perhaps, surely;
  };
  // Adds those of a block that is near.
  void AddTo(BlockKey block, Masks& masks) const;

 private:
  // Keys along x, from the first to the last; none if that is less.
  struct Row {
    std::int32_t first_perhaps, last_perhaps, first_surely, last_surely;
  };
  void MakeRows(const TurnedBox& box);
  void AddRows(BlockKey block, Masks& masks) const;
  bool Perhaps(const Eigen::Vector3d& center_W) const;
  bool Surely(const Eigen::Vector3d& center_W) const;

  const VoxelGrid& grid_;
  const Sweep& sweep_;
  CubeContact contact_;
  std::optional<KeyRange> keys_;
  std::vector<Row> rows_;  // of boxes: by y, then z, of the keys
};

}  // namespace clearway
