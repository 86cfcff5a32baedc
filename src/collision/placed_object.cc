#include "collision/placed_object.h"

#include <algorithm>

#include "collision/voxel_contact.h"
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

}  // namespace

double InflationOf(const MovingObject& object, Time t, const CheckOptions& options) {
  if (options.inflate_moving_only && object.velocity_O && object.AtRest()) return 0;
  return options.inflation_mps * std::max(0.0, ToSeconds(t - object.t_k())) +
         options.bound_multiple * object.bound.At(ToSeconds(t - object.LastPose().stamp));
}

ObjectSolids PrepareSolids(const SceneSnapshot& scene) {
  ObjectSolids solids;
  solids.reserve(scene.objects.size());
  for (const auto& object : scene.objects) {
    const Solid& solid = *object->solid;
    const bool wanted = object->FillsSolid(scene.params.solid) && !solid.hull->triangles.empty();
    solids.push_back(wanted ? std::make_unique<const ShapeGeometry>(solid.shape) : nullptr);
  }
  return solids;
}

bool IsIgnored(const MovingObject& object, const CheckOptions& options) {
  return std::any_of(options.ignored_objects.begin(), options.ignored_objects.end(),
                     [&](ObjectId id) { return object.IsCalled(id); });
}

std::set<std::pair<int, ObjectId>> AllowedContacts(const CheckOptions& options,
                                                   const SceneSnapshot& scene) {
  std::set<std::pair<int, ObjectId>> allowed;
  for (const auto& [link, id] : options.allowed_contacts) {
    const MovingObject* const object = scene.FindObject(id);
    allowed.emplace(link, object == nullptr ? id : object->id);
  }
  return allowed;
}

const std::vector<PlacedObject>& ObjectPlacer::Near(const Aabb& box_W, Time t) {
  wanted_.clear();
  index_.ForEachNear(box_W, t, t, options_.growth(),
                     [&](std::size_t index) { wanted_.push_back(index); });
  if (t == time_ && wanted_ == looked_at_) return placed_;
  time_ = t;
  looked_at_ = wanted_;
  placed_.clear();
  for (const std::size_t index : wanted_) {
    if (auto placed = Place(index, t)) placed_.push_back(*std::move(placed));
  }
  return placed_;
}

std::optional<PlacedObject> ObjectPlacer::Place(std::size_t index, Time t) const {
  const MovingObject& object = *scene_.objects[index];
  if (IsIgnored(object, options_)) return std::nullopt;
  const PredictedPose predicted = PredictPose(object, t, scene_.params.horizon);
  if (object.solid->box_O.Empty() && !predicted.beyond_horizon_radius_m) return std::nullopt;
  PlacedObject placed;
  placed.object = &object;
  placed.solid = solids_[index].get();
  placed.T_W_O = predicted.T_W_O;
  placed.T_O_W = Inverse(predicted.T_W_O);
  placed.ball_radius_m = predicted.beyond_horizon_radius_m;
  placed.margin_m = InflationOf(object, t, options_);
  placed.box_W = PlacedBox(placed);
  return placed;
}

bool Touches(const PlacedObject& placed, const PlacedShape& shape_W, double padding_m) {
  if (placed.ball_radius_m) return DistanceTo(placed, shape_W, padding_m) <= padding_m;
  if (placed.solid != nullptr) {
    return shape_W.Meets(*placed.solid, placed.T_W_O, padding_m + placed.margin_m);
  }
  return TouchesOccupied(placed.object->map_O, shape_W.In(placed.T_O_W),
                         padding_m + placed.margin_m);
}

double DistanceTo(const PlacedObject& placed, const PlacedShape& shape_W, double up_to_m) {
  const double search_m = up_to_m + placed.margin_m;
  double distance_m = 0;
  if (placed.ball_radius_m) {
    distance_m = shape_W.DistanceToBall(placed.T_W_O.translation, *placed.ball_radius_m, search_m);
  } else if (placed.solid != nullptr) {
    distance_m = shape_W.DistanceToShape(*placed.solid, placed.T_W_O, search_m);
  } else {
    distance_m = DistanceToOccupied(placed.object->map_O, shape_W.In(placed.T_O_W), search_m);
  }
  return std::max(0.0, distance_m - placed.margin_m);
}

}  // namespace clearway
