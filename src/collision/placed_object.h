// Moving objects as obstacles at one time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "collision/narrowphase.h"

namespace clearway {

// The hulls of a scene's objects, prepared once for all checks; null where an object has none. In
// the order of the scene's objects.
using ObjectHulls = std::vector<std::unique_ptr<const ShapeGeometry>>;
ObjectHulls PrepareHulls(const SceneSnapshot& scene);

// What an object blocks at one time: beyond its horizon a ball, else its solid. Refers to the scene
// and to its hull.
struct PlacedObject {
  const MovingObject* object = nullptr;
  const ShapeGeometry* hull = nullptr;  // null with SolidMode::kVoxels
  Pose T_W_O;
  Pose T_O_W;
  std::optional<double> ball_radius_m;  // about O's origin
  double margin_m = 0;                  // inflation: what lies this close counts as touched
  Aabb box_W;                           // around the solid or ball, margin included
};

// Every object that can be touched at `t` and is not ignored, by ascending ids.
std::vector<PlacedObject> PlaceObjects(const SceneSnapshot& scene, const ObjectHulls& hulls, Time t,
                                       const CheckOptions& options);

// Whether the shape (placed in W) is within padding_m of the object, the object's margin included.
bool Touches(const PlacedObject& object, const PlacedShape& shape_W, double padding_m);

// Distance in metres from the shape (placed in W) to the object, less the object's margin; 0 in
// contact, above up_to_m if farther than that.
double DistanceTo(const PlacedObject& object, const PlacedShape& shape_W, double up_to_m);

}  // namespace clearway
