#include "scene/object_points.h"

#include "clearway/map/ray_caster.h"
#include "scene/completion.h"
#include "scene/motion_from_points.h"
#include "scene/prediction_gate.h"
#include "scene/rays_near.h"

namespace clearway {
namespace {

// Misses of what was hit before: nothing else can be wrong, and the free space around an object is
// none of its map.
ScanUpdate MissesOf(const MovingObject& object, const LabelledCloud& cloud,
                    const SceneParams& params, ThreadPool& pool) {
  const Aabb box_O = object.observed_box_O.Padded(params.object_resolution_m);
  const ClippedRays rays = RaysWithin(box_O, object.history.back().T_W_O, cloud, params);
  // Rays that are too many clear nothing: only an object of some kilometres has them.
  const ScanUpdate cast =
      RayCaster(pool)
          .Cast(object.map_O.grid(), rays.Cloud(), {.octomap_ends = params.rays.octomap_ends})
          .value_or(ScanUpdate());
  ScanUpdate misses;
  for (std::size_t i = 0; i < cast.keys().size(); ++i) {
    const VoxelBlock* known = object.map_O.blocks().Find(cast.keys()[i]);
    if (known == nullptr) continue;
    BlockMask missed = cast.block(i).free;
    missed.Subtract(cast.block(i).end) &= known->observed;
    if (missed.Any()) misses.MarkFree(cast.keys()[i], missed);
  }
  return misses;
}

// See MovingObject::placed_box_O.
std::optional<Aabb> PlacedBoxAfter(const MovingObject& object,
                                   std::span<const Eigen::Vector3d> points_O) {
  if (!object.bridged) return std::nullopt;
  return GrownByView(object.placed_box_O ? *object.placed_box_O : object.observed_box_O, points_O);
}

}  // namespace

void AddPoints(MovingObject& object, const LabelledCloud& cloud,
               std::span<const std::uint32_t> points, Time stamp, const SceneParams& params,
               ThreadPool& pool) {
  const Pose T_O_W = Inverse(object.history.back().T_W_O);
  std::vector<Eigen::Vector3d> points_O = EndsOf(cloud, points);
  for (Eigen::Vector3d& p : points_O) p = T_O_W * p;
  object.placed_box_O = PlacedBoxAfter(object, points_O);
  VoxelMap map_O = object.map_O;
  ScanUpdate update;
  if (params.clear_objects_by_rays) update = MissesOf(object, cloud, params, pool);
  for (const Eigen::Vector3d& p_O : points_O) {
    if (map_O.grid().Addressable(p_O)) update.MarkHit(map_O.grid().KeyOf(p_O));
  }
  map_O.Update(update, pool);
  if (params.solid == SolidMode::kCompletedHull) {
    const bool one_origin = cloud.origins_W.size() == 1;
    const Eigen::Vector3f& sensor_W = cloud.origins_W[one_origin ? 0 : points.front()];
    object.completion = CompletionOf(object, sensor_W.cast<double>());
  }
  object = WithMap(std::move(object), std::move(map_O));
  if (object.bridged || MayBeEstimated(object, stamp, params)) {
    object.last_view = ViewOf(EndsOf(cloud, points), T_O_W, stamp, params);
  }
  object.last_seen = stamp;
  ++object.frames_seen;
}

}  // namespace clearway
