#include "collision/state_check.h"

#include <algorithm>

#include "collision/touching.h"
#include "collision/unknown_share.h"
#include "collision/voxel_contact.h"
#include "collision/voxel_distance.h"

namespace clearway {
namespace {

Pose Normalized(const Pose& pose) { return {pose.rotation.normalized(), pose.translation}; }

}  // namespace

StateCheck::StateCheck(const CheckContext& context, const RobotGeometry& robot)
    : context_(context), robot_(robot), bounds_W_(context.scene.params.bounds_W) {
  const double limit_m = context.scene.static_map_W.grid().limit_m();
  bounds_W_.min = bounds_W_.min.cwiseMax(-limit_m);
  bounds_W_.max = bounds_W_.max.cwiseMin(limit_m);
  bounds_W_ = bounds_W_.Padded(kContact_m);
}

void StateCheck::Place(const Pose* T_W_L) {
  shapes_W_.clear();
  first_shapes_.clear();
  for (std::size_t link = 0; link < robot_.links().size(); ++link) {
    first_shapes_.push_back(shapes_W_.size());
    const Pose& T_W_link = T_W_L[link];
    for (const auto& [geometry, T_L_G] : robot_.links()[link]) {
      if (T_L_G) {
        shapes_W_.emplace_back(geometry, Normalized(T_W_link) * *T_L_G);
      } else {
        shapes_W_.emplace_back(geometry, T_W_link);
      }
    }
  }
  first_shapes_.push_back(shapes_W_.size());
}

Aabb StateCheck::SearchedBox() const {
  Aabb box_W;
  for (const PlacedShape& shape : shapes_W_) box_W.Extend(shape.box_F());
  return box_W.Padded(ContactMargin() + context_.options.clearance_up_to_m.value_or(0));
}

std::span<const PlacedShape> StateCheck::ShapesOf(int link) const {
  return std::span(shapes_W_).subspan(first_shapes_[link],
                                      first_shapes_[link + 1] - first_shapes_[link]);
}

void StateCheck::Answer(Time time, const Pose* T_W_L, StateAnswer& answer) {
  Place(T_W_L);
  answer = {};
  if (OutOfBounds(answer)) {
    answer.status = SpaceStatus::kOutOfBounds;
    if (context_.options.NeedsUnknownFraction()) answer.unknown_fraction = 1;
    if (context_.options.clearance_up_to_m) answer.clearance_m = 0;
    return;
  }
  objects_ = &context_.objects.Near(SearchedBox(), time);
  if (context_.options.NeedsUnknownFraction()) answer.unknown_fraction = UnknownShare();
  answer.status = Status(answer);
  if (context_.options.clearance_up_to_m) answer.clearance_m = Clearance();
}

SpaceStatus StateCheck::Status(StateAnswer& answer) const {
  const CheckOptions& options = context_.options;
  if (Occupied(answer)) return SpaceStatus::kOccupied;
  if (!objects_->empty() && BeyondHorizon(answer)) return SpaceStatus::kBeyondHorizon;
  if (options.unknown == UnknownPolicy::kBlocked && Unobserved(answer)) {
    return SpaceStatus::kUnknownSpace;
  }
  if (options.unknown == UnknownPolicy::kTolerated &&
      *answer.unknown_fraction > options.max_unknown_fraction) {
    Blame(0, kStaticLabel, answer);
    return SpaceStatus::kUnknownSpace;
  }
  return SpaceStatus::kFree;
}

bool StateCheck::OutOfBounds(StateAnswer& answer) const {
  for (int link = 0; link < links(); ++link) {
    for (const PlacedShape& shape : ShapesOf(link)) {
      const Aabb& box_W = shape.box_F();
      if (bounds_W_.Contains(box_W.min) && bounds_W_.Contains(box_W.max)) continue;
      return Blame(link, kStaticLabel, answer);
    }
  }
  return false;
}

bool StateCheck::Occupied(StateAnswer& answer) const {
  for (int link = 0; link < links(); ++link) {
    if (!Allowed(link, kStaticLabel) && TouchesStatic(link)) {
      return Blame(link, kStaticLabel, answer);
    }
    for (const PlacedObject& object : *objects_) {
      if (!object.ball_radius_m && TouchesObject(link, object)) {
        return Blame(link, object.object->id, answer);
      }
    }
  }
  return false;
}

bool StateCheck::BeyondHorizon(StateAnswer& answer) const {
  for (int link = 0; link < links(); ++link) {
    for (const PlacedObject& object : *objects_) {
      if (object.ball_radius_m && TouchesObject(link, object)) {
        return Blame(link, object.object->id, answer);
      }
    }
  }
  return false;
}

bool StateCheck::Unobserved(StateAnswer& answer) const {
  const VoxelMap& map = context_.scene.static_map_W;
  for (int link = 0; link < links(); ++link) {
    for (const PlacedShape& shape : ShapesOf(link)) {
      if (TouchesUnobserved(map, shape, context_.options.known_free_W, ContactMargin(),
                            context_.cancelled)) {
        return Blame(link, kStaticLabel, answer);
      }
    }
  }
  return false;
}

double StateCheck::UnknownShare() const {
  std::vector<const PlacedShape*> shapes;
  for (const PlacedShape& shape : shapes_W_) shapes.push_back(&shape);
  return UnknownShareOf(context_.scene.static_map_W, context_.options.known_free_W, shapes,
                        context_.cancelled);
}

// Lets every kind of obstacle search only as far as the nearest one so far.
double StateCheck::Clearance() const {
  const CheckOptions& options = context_.options;
  const double padding_m = options.padding_m;
  double nearest_m = *options.clearance_up_to_m + padding_m;
  for (int link = 0; link < links(); ++link) {
    if (!Allowed(link, kStaticLabel)) {
      nearest_m = std::min(nearest_m, StaticDistance(link, nearest_m));
    }
    for (const PlacedShape& shape : ShapesOf(link)) {
      for (const PlacedObject& object : *objects_) {
        if (Allowed(link, object.object->id)) continue;
        nearest_m = std::min(nearest_m, DistanceTo(object, shape, nearest_m));
      }
      if (options.unknown != UnknownPolicy::kBlocked) continue;
      nearest_m = std::min(
          nearest_m, DistanceToUnobserved(context_.scene.static_map_W, shape, options.known_free_W,
                                          nearest_m, context_.cancelled));
    }
  }
  return std::max(0.0, nearest_m - padding_m);
}

double StateCheck::ContactMargin() const { return context_.options.padding_m + kContact_m; }

bool StateCheck::Allowed(int link, ObjectId object) const {
  return context_.allowed_contacts.contains({link, object});
}

bool StateCheck::TouchesStatic(int link) const {
  const double margin_m = ContactMargin();
  for (const PlacedShape& shape : ShapesOf(link)) {
    for (const Aabb& box_W : context_.scene.params.keep_out_W) {
      if (shape.DistanceTo(box_W, margin_m) <= margin_m) return true;
    }
    if (TouchesOccupied(context_.scene.static_map_W, shape, margin_m)) return true;
  }
  return false;
}

bool StateCheck::TouchesObject(int link, const PlacedObject& object) const {
  if (Allowed(link, object.object->id)) return false;
  const double margin_m = ContactMargin();
  for (const PlacedShape& shape : ShapesOf(link)) {
    if (!shape.box_F().Padded(margin_m).Intersects(object.box_W)) continue;
    if (Touches(object, shape, margin_m)) return true;
  }
  return false;
}

double StateCheck::StaticDistance(int link, double up_to_m) const {
  double nearest_m = up_to_m;
  for (const PlacedShape& shape : ShapesOf(link)) {
    for (const Aabb& box_W : context_.scene.params.keep_out_W) {
      nearest_m = std::min(nearest_m, shape.DistanceTo(box_W, nearest_m));
    }
    nearest_m =
        std::min(nearest_m, DistanceToOccupied(context_.scene.static_map_W, shape, nearest_m));
  }
  return nearest_m;
}

}  // namespace clearway
