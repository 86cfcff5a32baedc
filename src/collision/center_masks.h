// Voxels whose centre lies in a shape.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/cube_contact.h"
#include "collision/narrowphase.h"
#include "collision/voxel_search.h"

namespace clearway {

// A shape on a straight way, without turning, no point of which ever is farther than margin_m from
// where that puts it. In W.
struct LooseShape {
  PlacedShape shape_W;  // where it begins
  Eigen::Vector3d way_W = Eigen::Vector3d::Zero();
  double margin_m = 0;

  // Around all of it.
  Aabb Box() const {
    Aabb box_W = shape_W.box_F();
    box_W.Extend(Aabb{box_W.min + way_W, box_W.max + way_W});
    return box_W.Padded(margin_m);
  }
};

// Tells of the centres of voxels whether such a shape may hold them somewhere on its way, and
// whether it surely does all along. Of a box a row of voxels along x is told at once. Refers to the
// shape.
class CenterMasks {
 public:
  CenterMasks(const VoxelGrid& grid, const LooseShape& shape);

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
  const LooseShape& shape_;
  CubeContact contact_;
  std::optional<KeyRange> keys_;
  std::vector<Row> rows_;  // of boxes: by y, then z, of the keys
};

}  // namespace clearway
