#include "scene/surroundings.h"

#include <algorithm>
#include <utility>

#include "clearway/map/ray_caster.h"
#include "scene/rays_near.h"
#include "scene/reidentification.h"
#include "scene/same_object.h"
#include "scene/voxel_neighbours.h"

namespace clearway {
namespace {

// In O of the young one: where those would be that it could be.
Aabb BoxOfLost(const ObjectMap& objects, const MovingObject& young, const SceneParams& params) {
  const Pose T_Y_W = Inverse(FirstPose(young).T_W_O);
  Aabb box_Y;
  for (const auto& [id, lost] : objects) {
    if (!WasLostBefore(*lost, young)) continue;
    const std::optional<PlaceIfSame> place = PlaceToBeSeenAgain(*lost, young, params);
    if (!place) continue;
    const Aabb lost_Y = Transformed(T_Y_W * place->T_W_L, lost->observed_box_O);
    box_Y.Extend(lost_Y.Padded(place->tolerance_m));
  }
  return box_Y;
}

void Add(const LabelledCloud& cloud, const Aabb& box_Y, const Pose& T_W_Y,
         const SceneParams& params, ThreadPool& pool, VoxelMap& around_Y) {
  ClippedRays rays = RaysWithin(box_Y, T_W_Y, cloud, params);
  std::ranges::replace(rays.kinds, RayEnd::kBlock, RayEnd::kHit);
  const auto update = RayCaster(pool).Cast(around_Y.grid(), rays.Cloud(), {});
  if (update) around_Y.Update(*update, pool);
}

// With all that touches it.
bool IsPassed(const VoxelMap& map_L, VoxelKey key, const Pose& T_Y_L, const VoxelMap& around_Y) {
  return std::ranges::all_of(WithNeighbours(key), [&](VoxelKey near) {
    if (map_L.State(near) != VoxelState::kOccupied) return true;
    const Eigen::Vector3d p_Y = T_Y_L * map_L.grid().CenterOf(near);
    return around_Y.grid().Addressable(p_Y) &&
           around_Y.State(around_Y.grid().KeyOf(p_Y)) == VoxelState::kFree;
  });
}

}  // namespace

Surroundings SeenAround(const Surroundings& before, const ObjectMap& objects,
                        const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                        ThreadPool& pool) {
  constexpr Duration kPlaced = std::chrono::milliseconds(100);  // another sensor's scan is near
  Surroundings around;
  for (const auto& [id, young] : objects) {
    if (young->given() || !IsYoung(*young, stamp)) continue;
    const auto known = before.find(id);
    // What was first seen now is another one than that which went by its id before.
    const bool goes_on = known != before.end() && young->first_seen < stamp;
    VoxelMap around_Y =
        goes_on ? known->second : VoxelMap(params.object_resolution_m, params.Model());
    if (stamp - young->t_k() <= kPlaced) {
      const Pose T_W_Y = PredictPose(*young, stamp, params.horizon).T_W_O;
      const Aabb box_Y = BoxOfLost(objects, *young, params);
      if (!box_Y.Empty()) Add(cloud, box_Y, T_W_Y, params, pool, around_Y);
    }
    around.emplace(id, std::move(around_Y));
  }
  return around;
}

bool WouldBeSeenThrough(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                        const VoxelMap& around_Y) {
  constexpr std::size_t kOneIn = 5;
  const VoxelMap& map_L = lost.map_O;
  std::size_t passed = 0, there = 0;
  map_L.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      const bool is_there = NearOccupied(young.map_O, T_Y_L * map_L.grid().CenterOf(key));
      there += is_there;
      passed += !is_there && IsPassed(map_L, key, T_Y_L, around_Y);
    });
  });
  return kOneIn * passed > passed + there;
}

}  // namespace clearway
