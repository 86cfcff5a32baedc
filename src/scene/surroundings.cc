#include "scene/surroundings.h"

#include <algorithm>
#include <utility>

#include "clearway/map/ray_caster.h"
#include "scene/rays_near.h"
#include "scene/reidentification.h"
#include "scene/same_object.h"

namespace clearway {
namespace {

// In O of the young one: where those would be that it could be, as whose part it is seen.
Aabb BoxOfLost(const ObjectMap& objects, const MovingObject& young, const SceneParams& params) {
  constexpr double kBeyond_voxels = 6;
  const Pose T_Y_W = Inverse(FirstPose(young).T_W_O);
  const Aabb young_Y = young.observed_box_O.Padded(kBeyond_voxels * params.object_resolution_m);
  Aabb box_Y;
  for (const auto& [id, lost] : objects) {
    if (!WasLostBefore(*lost, young)) continue;
    const std::optional<PlaceIfSame> place = PlaceToBeSeenAgain(*lost, young, params);
    if (!place) continue;
    const Aabb lost_Y = Transformed(T_Y_W * place->T_W_L, lost->observed_box_O);
    const Eigen::Vector3d unseen_m = (lost_Y.Size() - young_Y.Size()).cwiseMax(0);
    const Aabb around_Y{young_Y.min - unseen_m, young_Y.max + unseen_m};
    const Aabb may_be_Y = Intersection(lost_Y.Padded(place->tolerance_m), around_Y);
    if (!may_be_Y.Empty()) box_Y.Extend(may_be_Y);
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

}  // namespace

Surroundings SeenAround(const Surroundings& before, const ObjectMap& objects,
                        const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                        ThreadPool& pool) {
  Surroundings around;
  for (const auto& [id, young] : objects) {
    if (young->given() || !IsYoung(*young, stamp)) continue;
    const auto known = before.find(id);
    // What was first seen now is another one than that which went by its id before.
    const bool goes_on = known != before.end() && young->first_seen < stamp;
    VoxelMap around_Y =
        goes_on ? known->second : VoxelMap(params.object_resolution_m, params.Model());
    // By another sensor's scan, too, if it is known where the young one is then.
    const bool is_placed =
        young->t_k() == stamp || (young->velocity_O && stamp - young->t_k() <= kOutOfSight);
    if (is_placed) {
      const Pose T_W_Y = PredictPose(*young, stamp, params.horizon).T_W_O;
      const Aabb box_Y = BoxOfLost(objects, *young, params);
      if (!box_Y.Empty()) Add(cloud, box_Y, T_W_Y, params, pool, around_Y);
    }
    around.emplace(id, std::move(around_Y));
  }
  return around;
}

}  // namespace clearway
