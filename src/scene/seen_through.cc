#include "scene/seen_through.h"

#include <algorithm>

#include "clearway/map/ray_caster.h"
#include "scene/rays_near.h"
#include "scene/voxel_neighbours.h"

namespace clearway {
namespace {

bool Passed(const ScanUpdate& update, VoxelKey key) {
  const ScanUpdate::Block* block = update.Find(BlockOf(key));
  const int index = IndexInBlock(key);
  return block != nullptr && block->free.Test(index) && !block->end.Test(index);
}

bool PassedWithItsSurface(const ScanUpdate& update, const VoxelMap& map, VoxelKey key) {
  return std::ranges::all_of(WithNeighbours(key), [&](VoxelKey near) {
    return map.State(near) != VoxelState::kOccupied || Passed(update, near);
  });
}

}  // namespace

bool WouldBeSeenThrough(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                        const LabelledCloud& cloud, const SceneParams& params, ThreadPool& pool) {
  constexpr std::size_t kOneIn = 5;
  const Pose T_W_L = young.history.back().T_W_O * T_Y_L;
  const Aabb box_L = lost.observed_box_O.Padded(params.object_resolution_m);
  const ClippedRays rays = RaysWithin(box_L, T_W_L, cloud, params);
  const VoxelMap& map_L = lost.map_O;
  const auto update = RayCaster(pool).Cast(map_L.grid(), rays.Cloud(), {});
  if (!update) return false;
  std::size_t passed = 0, there = 0;
  map_L.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      const bool is_there = NearOccupied(young.map_O, T_Y_L * map_L.grid().CenterOf(key));
      there += is_there;
      passed += !is_there && PassedWithItsSurface(*update, map_L, key);
    });
  });
  return kOneIn * passed > passed + there;
}

}  // namespace clearway
