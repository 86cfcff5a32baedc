// Distance from a shape to the voxels of a map.
#pragma once

#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/narrowphase.h"
#include "collision/voxel_search.h"

namespace clearway {

// The distance in metres to the nearest occupied voxel, or above up_to_m if there is none so near.
double DistanceToOccupied(const VoxelMap& map, const PlacedShape& shape, double up_to_m);

// To the nearest voxel never observed whose centre lies in none of the boxes. Meaningless once
// `cancelled`.
double DistanceToUnobserved(const VoxelMap& map, const PlacedShape& shape,
                            const std::vector<Aabb>& known_free, double up_to_m,
                            const Cancelled& cancelled);

}  // namespace clearway
