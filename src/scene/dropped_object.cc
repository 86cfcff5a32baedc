#include "scene/dropped_object.h"

#include <cmath>
#include <utility>
#include <vector>

namespace clearway {

void ForgetFreeSpaceOf(const MovingObject& object, VoxelMap& map_W) {
  const Pose& T_W_O = object.history.back().T_W_O;
  const Pose T_O_W = Inverse(T_W_O);
  const VoxelGrid& grid = map_W.grid();
  const double half_diagonal_m = 0.5 * std::sqrt(3.0) * grid.resolution_m();
  const Aabb box_W = Transformed(T_W_O, object.solid->box_O).Padded(grid.resolution_m());
  if (box_W.Empty() || !grid.Addressable(box_W.min) || !grid.Addressable(box_W.max)) return;

  std::vector<std::pair<BlockKey, VoxelBlock>> changed;
  const auto forget_inside = [&](BlockKey key, const VoxelBlock& before) {
    VoxelBlock block = before;
    BlockMask free = before.observed;
    free.Subtract(before.occupied).ForEach([&](int index) {
      const Eigen::Vector3d p_W = grid.CenterOf(VoxelAt(key, index));
      if (box_W.Contains(p_W) && NearHull(*object.solid->hull, T_O_W * p_W, half_diagonal_m)) {
        block.Forget(index);
      }
    });
    if (block != before) changed.emplace_back(key, block);
  };
  map_W.blocks().ForEachIn(BlockOf(grid.KeyOf(box_W.min)), BlockOf(grid.KeyOf(box_W.max)),
                           forget_inside);
  for (const auto& [key, block] : changed) map_W.PutBlock(key, block);
}

}  // namespace clearway
