#include "clearway/scene/occupancy.h"

#include <algorithm>

#include "clearway/scene/timed_scene.h"
#include "scene/query_ray.h"

namespace clearway {
namespace {

Aabb PlacedBox(const MovingObject& object, const PredictedPose& predicted) {
  if (predicted.beyond_horizon_radius_m) {
    const Eigen::Vector3d& center = predicted.T_W_O.translation;
    return Aabb{center, center}.Padded(*predicted.beyond_horizon_radius_m);
  }
  Aabb box_O = object.observed_box_O;
  box_O.Extend(object.solid->box_O);
  return Transformed(predicted.T_W_O, box_O);
}

bool InKeepOut(const SceneParams& params, const Eigen::Vector3d& p_W) {
  for (const Aabb& box : params.keep_out_W) {
    if (box.Contains(p_W)) return true;
  }
  return false;
}

// Adds what one placed object says of the point to the answer; returns the status it asks for.
SpaceStatus ObjectSays(const SceneAtTime::Placed& placed, SolidMode mode,
                       const Eigen::Vector3d& p_W, std::optional<double>& fused_log_odds) {
  const MovingObject& object = *placed.object;
  if (placed.beyond_horizon_radius_m) {
    const double distance_m = (p_W - placed.T_W_O.translation).norm();
    return distance_m <= *placed.beyond_horizon_radius_m ? SpaceStatus::kBeyondHorizon
                                                         : SpaceStatus::kFree;
  }
  const Eigen::Vector3d p_O = placed.T_O_W * p_W;
  if (const auto value = object.map_O.Find(object.map_O.grid().KeyOf(p_O))) {
    fused_log_odds = fused_log_odds.value_or(0.0) + Dequantized(*value);
    if (object.map_O.model().Occupied(*value)) return SpaceStatus::kOccupied;
  }
  if (object.FillsSolid(mode) && object.solid->box_O.Contains(p_O) &&
      Contains(object.solid->shape, p_O)) {
    return SpaceStatus::kOccupied;
  }
  return SpaceStatus::kFree;
}

}  // namespace

SceneAtTime::Placed SceneAtTime::Place(const SceneSnapshot& scene, const MovingObject& object,
                                       Time t) {
  const PredictedPose predicted = PredictPose(object, t, scene.params.horizon);
  return {&object, predicted.T_W_O, Inverse(predicted.T_W_O), predicted.beyond_horizon_radius_m,
          PlacedBox(object, predicted)};
}

SceneAtTime::SceneAtTime(const SceneSnapshot& scene, Time t) : scene_(&scene), time_(t) {
  objects_.reserve(scene.objects.size());
  for (const auto& object : scene.objects) objects_.push_back(Place(scene, *object, t));
}

PointOccupancy SceneAtTime::At(const Eigen::Vector3d& p_W) const {
  const VoxelMap& map = scene_->static_map_W;
  PointOccupancy answer = StaticOccupancy(
      *scene_, p_W, map.grid().Addressable(p_W) ? map.Find(map.grid().KeyOf(p_W)) : std::nullopt);
  if (answer.status == SpaceStatus::kOutOfBounds) return answer;
  for (const Placed& placed : objects_) AddObject(*scene_, placed, p_W, answer);
  return answer;
}

PointOccupancy StaticOccupancy(const SceneSnapshot& scene, const Eigen::Vector3d& p_W,
                               std::optional<LogOdds> stored) {
  const VoxelMap& map = scene.static_map_W;
  if (!scene.params.bounds_W.Contains(p_W) || !map.grid().Addressable(p_W)) {
    return {SpaceStatus::kOutOfBounds, kStaticLabel, std::nullopt};
  }
  PointOccupancy answer;
  if (stored) answer.fused_log_odds = Dequantized(*stored);
  answer.status = stored ? SpaceStatus::kFree : SpaceStatus::kUnknownSpace;
  const bool occupied = stored && map.model().Occupied(*stored);
  if (occupied || InKeepOut(scene.params, p_W)) answer.status = SpaceStatus::kOccupied;
  answer.dynamic = occupied && scene.dynamic_W.Find(map.grid().KeyOf(p_W)) != nullptr;
  return answer;
}

void AddObject(const SceneSnapshot& scene, const SceneAtTime::Placed& placed,
               const Eigen::Vector3d& p_W, PointOccupancy& answer) {
  if (!placed.box_W.Contains(p_W)) return;
  const SpaceStatus status = ObjectSays(placed, scene.params.solid, p_W, answer.fused_log_odds);
  if (status == SpaceStatus::kFree || status <= answer.status) return;
  answer.status = status;
  answer.object = placed.object->id;
}

std::vector<PointOccupancy> OccupancyOf(const SceneSnapshot& scene,
                                        std::span<const Eigen::Vector3d> points_W,
                                        std::span<const Time> times) {
  std::vector<PointOccupancy> answers(points_W.size());
  if (points_W.empty()) return answers;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  std::vector<Time> each(times.begin(), times.end());
  each.resize(points_W.size(), times[0]);
  TimedScene(scene, *first, *last).At(points_W, each, answers);
  return answers;
}

RayAnswer CastQueryRay(const SceneAtTime& scene, const Eigen::Vector3d& origin_W,
                       const Eigen::Vector3d& direction_W, double max_range_m) {
  return QueryRay(scene.scene(), origin_W, direction_W, max_range_m)
      .Cast([&](const Eigen::Vector3d& p_W) { return scene.At(p_W); }, [] { return false; });
}

}  // namespace clearway
