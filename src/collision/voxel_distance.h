// Distance from a shape to the voxels of a map.
#pragma once

#include <vector>

#include "collision/narrowphase.h"
#include "collision/voxel_search.h"

namespace clearway {

// Whether a voxel of the kind for which counts(VoxelKey) holds lies within margin_m of the shape,
// placed in the map's frame.
template <class Kind, class Counts>
bool TouchesVoxels(const VoxelMap& map, const PlacedShape& shape, double margin_m,
                   Counts&& counts) {
  KeyRange keys;
  if (!KeysTouching(map.grid(), shape.box_F().Padded(margin_m), keys)) return false;
  return AnyVoxel<Kind>(map, keys, [&](VoxelKey key) {
    return counts(key) && shape.DistanceTo(map.grid().BoxOf(key), margin_m) <= margin_m;
  });
}

// The distance in metres to the nearest voxel of that sort, or above up_to_m if there is none so
// near.
double DistanceToOccupied(const VoxelMap& map, const PlacedShape& shape, double up_to_m);

// To the nearest voxel never observed whose centre lies in none of the boxes.
double DistanceToUnobserved(const VoxelMap& map, const PlacedShape& shape,
                            const std::vector<Aabb>& known_free, double up_to_m);

}  // namespace clearway
