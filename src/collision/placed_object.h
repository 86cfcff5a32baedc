// Moving objects as obstacles at one time.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "clearway/scene/object_index.h"
#include "collision/narrowphase.h"

namespace clearway {

// What a scene's objects fill, as convex shapes prepared once for all checks: the hulls of their
// voxels and the shapes that are given; null where an object's voxels alone count. In the order of
// the scene's objects.
using ObjectSolids = std::vector<std::unique_ptr<const ShapeGeometry>>;
ObjectSolids PrepareSolids(const SceneSnapshot& scene);

// By how much the object is grown at `t`, in metres.
double InflationOf(const MovingObject& object, Time t, const CheckOptions& options);

// By any of its ids.
bool IsIgnored(const MovingObject& object, const CheckOptions& options);
// The options' allowed contacts, by first ids alone.
std::set<std::pair<int, ObjectId>> AllowedContacts(const CheckOptions& options,
                                                   const SceneSnapshot& scene);

// What an object blocks at one time: beyond its horizon a ball, else its solid. Refers to the scene
// and to its shape.
struct PlacedObject {
  const MovingObject* object = nullptr;
  const ShapeGeometry* solid = nullptr;  // null if its voxels alone count
  Pose T_W_O;
  Pose T_O_W;
  std::optional<double> ball_radius_m;  // about O's origin
  double margin_m = 0;                  // inflation: what lies this close counts as touched
  Aabb box_W;                           // around the solid or ball, margin included
};

// Places the objects that a state may touch, each once for the states in a row that have the same
// time. One thread. Refers to what it is made of.
class ObjectPlacer {
 public:
  ObjectPlacer(const SceneSnapshot& scene, const ObjectSolids& solids, const ObjectIndex& index,
               const CheckOptions& options)
      : scene_(scene), solids_(solids), index_(index), options_(options) {}

  // The objects that may meet the box at `t` and are not ignored, by ascending ids, and perhaps a
  // few others. Valid until the next call.
  const std::vector<PlacedObject>& Near(const Aabb& box_W, Time t);

 private:
  std::optional<PlacedObject> Place(std::size_t index, Time t) const;

  const SceneSnapshot& scene_;
  const ObjectSolids& solids_;
  const ObjectIndex& index_;
  const CheckOptions& options_;
  Time time_;                        // of what follows
  std::vector<std::size_t> wanted_;  // by the last call
  std::vector<std::size_t> looked_at_;
  std::vector<PlacedObject> placed_;  // those of looked_at_ that there are to touch
};

// Whether the shape (placed in W) is within padding_m of the object, the object's margin included.
bool Touches(const PlacedObject& object, const PlacedShape& shape_W, double padding_m);

// Distance in metres from the shape (placed in W) to the object, less the object's margin; 0 in
// contact, above up_to_m if farther than that.
double DistanceTo(const PlacedObject& object, const PlacedShape& shape_W, double up_to_m);

}  // namespace clearway
