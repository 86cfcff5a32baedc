#include "collision/placed_object.h"

#include <algorithm>

#include "collision/voxel_distance.h"

namespace clearway {
namespace {

Aabb PlacedBox(const PlacedObject& placed) {
  if (placed.ball_radius_m) {
    const Eigen::Vector3d& center_W = placed.T_W_O.translation;
    return Aabb{center_W, center_W}.Padded(*placed.ball_radius_m + placed.margin_m);
  }
  return Transformed(placed.T_W_O, placed.object->solid->box_O).Padded(placed.margin_m);
}

double InflationOf(const MovingObject& object, Time t, const CheckOptions& options) {
  if (options.inflate_moving_only && object.velocity_O && object.AtRest()) return 0;
  return options.inflation_mps * std::max(0.0, ToSeconds(t - object.t_k()));
}

}  // namespace

ObjectHulls PrepareHulls(const SceneSnapshot& scene) {
  ObjectHulls hulls;
  hulls.reserve(scene.objects.size());
  for (const auto& object : scene.objects) {
    const bool wanted =
        scene.params.solid == SolidMode::kConvexHull && !object->solid->hull->triangles.empty();
    hulls.push_back(wanted
                        ? std::make_unique<const ShapeGeometry>(ConvexPolytope{object->solid->hull})
                        : nullptr);
  }
  return hulls;
}

std::vector<PlacedObject> PlaceObjects(const SceneSnapshot& scene, const ObjectHulls& hulls, Time t,
                                       const CheckOptions& options) {
  std::vector<PlacedObject> placed;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const MovingObject& object = *scene.objects[i];
    if (std::find(options.ignored_objects.begin(), options.ignored_objects.end(), object.id) !=
        options.ignored_objects.end()) {
      continue;
    }
    const PredictedPose predicted = PredictPose(object, t, scene.params.horizon);
    if (object.solid->box_O.Empty() && !predicted.beyond_horizon_radius_m) continue;
    PlacedObject& added = placed.emplace_back();
    added.object = &object;
    added.hull = hulls[i].get();
    added.T_W_O = predicted.T_W_O;
    added.T_O_W = Inverse(predicted.T_W_O);
    added.ball_radius_m = predicted.beyond_horizon_radius_m;
    added.margin_m = InflationOf(object, t, options);
    added.box_W = PlacedBox(added);
  }
  return placed;
}

bool Touches(const PlacedObject& placed, const PlacedShape& shape_W, double padding_m) {
  if (placed.ball_radius_m || placed.hull != nullptr) {
    return DistanceTo(placed, shape_W, padding_m) <= padding_m;
  }
  return TouchesOccupied(placed.object->map_O, shape_W.In(placed.T_O_W),
                         padding_m + placed.margin_m);
}

double DistanceTo(const PlacedObject& placed, const PlacedShape& shape_W, double up_to_m) {
  const double search_m = up_to_m + placed.margin_m;
  double distance_m = 0;
  if (placed.ball_radius_m) {
    distance_m = shape_W.DistanceToBall(placed.T_W_O.translation, *placed.ball_radius_m, search_m);
  } else if (placed.hull != nullptr) {
    distance_m = shape_W.DistanceToHull(*placed.hull, placed.T_W_O, search_m);
  } else {
    distance_m = DistanceToOccupied(placed.object->map_O, shape_W.In(placed.T_O_W), search_m);
  }
  return std::max(0.0, distance_m - placed.margin_m);
}

}  // namespace clearway
