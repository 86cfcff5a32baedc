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

// Whether it is time to look beside it, too, for when it will be lost: not at each of its sights,
// for that takes long, and not at the same time as for the others.
bool IsLookedBeside(const MovingObject& object, Time stamp) {
  constexpr std::int64_t kOneOf = 8;
  return object.t_k() == stamp && (object.id + object.frames_seen) % kOneOf == 0;
}

Aabb BoxBeside(const MovingObject& object, const SceneParams& params) {
  return object.observed_box_O.Padded(kReachesBeyond_voxels * params.object_resolution_m);
}

// In O; empty if there is nothing to look for.
Aabb BoxToLookAt(const ObjectMap& objects, const MovingObject& object, Time stamp,
                 const SceneParams& params) {
  Aabb box_O;
  // By another sensor's scan, too, if it is known where the object is then.
  const bool is_placed =
      object.t_k() == stamp || (object.velocity_O && stamp - object.t_k() <= kOutOfSight &&
                                stamp >= object.history.front().stamp);
  if (is_placed && IsYoung(object, stamp)) box_O = BoxOfLost(objects, object, params);
  if (IsLookedBeside(object, stamp)) box_O.Extend(BoxBeside(object, params));
  return box_O;
}

void Add(const LabelledCloud& cloud, const Aabb& box_O, const Pose& T_W_O,
         const SceneParams& params, ThreadPool& pool, VoxelMap& around_O) {
  ClippedRays rays = RaysWithin(box_O, T_W_O, cloud, params);
  std::ranges::replace(rays.kinds, RayEnd::kBlock, RayEnd::kHit);
  // Of the voxels at the box's border rays may have seen a sliver.
  const RayOptions options{.octomap_ends = true};
  const auto update = RayCaster(pool).Cast(around_O.grid(), rays.Cloud(), options);
  if (update) around_O.Update(*update, pool);
}

}  // namespace

Surroundings SeenAround(const Surroundings& before, const ObjectMap& objects,
                        const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                        ThreadPool& pool) {
  Surroundings around;
  for (const auto& [id, object] : objects) {
    if (object->given()) continue;
    const auto known = before.find(id);
    // What was first seen now is another one than that which went by its id before.
    const bool goes_on = known != before.end() && object->first_seen != stamp;
    VoxelMap around_O =
        goes_on ? known->second : VoxelMap(params.object_resolution_m, params.Model());
    const Aabb box_O = BoxToLookAt(objects, *object, stamp, params);
    if (!box_O.Empty()) {
      const Pose T_W_O = PredictPose(*object, stamp, params.horizon).T_W_O;
      Add(cloud, box_O, T_W_O, params, pool, around_O);
    }
    around.emplace(id, std::move(around_O));
  }
  return around;
}

}  // namespace clearway
