#include "clearway/report/box_residue.h"

#include <algorithm>

#include "absl/container/flat_hash_map.h"
#include "report/box_voxels.h"

namespace clearway {
namespace {

Aabb BoxB(const TrueBox& box) { return {-0.5 * box.size_m, 0.5 * box.size_m}; }

// Without what is near its faces; may be empty.
Aabb MiddleOf(const TrueBox& box, double voxel_m) {
  const Eigen::Vector3d margin_m = Eigen::Vector3d::Constant(voxel_m);
  Aabb middle_B{-0.5 * box.size_m + margin_m, 0.5 * box.size_m - margin_m};
  middle_B.min.z() = -0.5 * box.size_m.z() + std::max(voxel_m, BoxResidueScore::kGround_m);
  return middle_B;
}

}  // namespace

void BoxResidueScore::Add(Time stamp) {
  for (const TrueBox& box : truth_.boxes(stamp)) {
    if (box.size_m.isZero()) continue;
    boxes_.push_back(box);
    last_[box.id] = box;
  }
}

BoxResidue BoxResidueScore::Of(const VoxelMap& map_W) const {
  const VoxelGrid& grid = map_W.grid();
  const double voxel_m = grid.resolution_m();
  absl::flat_hash_map<BlockKey, BlockMask> passed;
  for (const TrueBox& box : boxes_) {
    ForEachRowIn(grid, MiddleOf(box, voxel_m), box.T_W_B, [&](VoxelKey key, std::int32_t count) {
      for (; count > 0; --count, ++key.x) passed[BlockOf(key)].Set(IndexInBlock(key));
    });
  }
  for (const auto& [id, box] : last_) {
    ForEachRowIn(grid, BoxB(box).Padded(voxel_m), box.T_W_B, [&](VoxelKey key, std::int32_t count) {
      for (; count > 0; --count, ++key.x) {
        const auto mask = passed.find(BlockOf(key));
        if (mask != passed.end()) mask->second.Clear(IndexInBlock(key));
      }
    });
  }
  BoxResidue residue;
  for (auto& [key, mask] : passed) {
    residue.passed += mask.Count();
    if (const VoxelBlock* block = map_W.blocks().Find(key)) {
      residue.occupied += (mask &= block->occupied).Count();
    }
  }
  return residue;
}

}  // namespace clearway
