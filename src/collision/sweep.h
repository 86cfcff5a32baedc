// How far a shape goes until it touches something.
#pragma once

#include <optional>
#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/advance.h"
#include "collision/narrowphase.h"
#include "collision/spread.h"
#include "collision/voxel_search.h"

namespace clearway {

// A shape on a straight way, without turning, with a margin round it, and beyond that as far as its
// points spread. In one frame F.
struct Sweep {
  PlacedShape shape_F;  // where it begins
  Eigen::Vector3d way_F;
  double margin_m;
  double tolerance_m = 0;  // how much too early a touch may be said to be

  Spread spread_F = {};

  bool AtRest() const { return spread_F.empty() && way_F.isZero(0); }
  // In every direction.
  double LargestMargin() const { return margin_m + spread_F.radius_m(); }
  // Around the shape where it begins.
  Aabb BoxAtStart() const {
    const Aabb box = shape_F.box_F().Padded(margin_m);
    return {box.min - spread_F.half_m(), box.max + spread_F.half_m()};
  }
  // Around all of it and what it touches.
  Aabb Box() const {
    Aabb box = BoxAtStart().Padded(kTouching_m);
    box.Extend(Aabb{box.min + way_F, box.max + way_F});
    return box;
  }
};

// Where on its way a shape may touch something first: a share of the way, from 0 to 1. Before that
// it certainly does not. kNever: nowhere.
struct FirstTouch {
  double share = kNever;
  std::optional<VoxelKey> voxel;  // the one that is touched, if it is one
};

// Each looks only as far as `until`, a share, and answers kNever if there is nothing before it. A
// shape at rest touches nothing if its state is free.
//
// Occupied voxels of a map in F.
FirstTouch TouchOccupied(const VoxelMap& map_F, const Sweep& sweep, double until);
// Voxels never observed whose centre lies in none of the boxes. Meaningless once `cancelled`.
FirstTouch TouchUnobserved(const VoxelMap& map_F, const std::vector<Aabb>& known_free_F,
                           const Sweep& sweep, double until, const Cancelled& cancelled);
FirstTouch TouchBox(const Aabb& box_F, const Sweep& sweep, double until);
// A convex shape whose frame is F.
FirstTouch TouchShape(const ShapeGeometry& shape, const Sweep& sweep, double until);
FirstTouch TouchBall(const Eigen::Vector3d& center_F, double radius_m, const Sweep& sweep,
                     double until);

// Where the shape, its margin included, exceeds the bounds first by more than a state may.
FirstTouch LeaveBounds(const Aabb& bounds_F, const Sweep& sweep);

}  // namespace clearway
