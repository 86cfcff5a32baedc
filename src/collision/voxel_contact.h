// Contact of a shape with the voxels of a map.
#pragma once

#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/narrowphase.h"
#include "collision/voxel_search.h"

namespace clearway {

// Whether an occupied voxel lies within margin_m of the shape, placed in the map's frame.
bool TouchesOccupied(const VoxelMap& map, const PlacedShape& shape, double margin_m);

// Whether a voxel never observed does, whose centre lies in none of the boxes. Meaningless once
// `cancelled`.
bool TouchesUnobserved(const VoxelMap& map, const PlacedShape& shape,
                       const std::vector<Aabb>& known_free, double margin_m,
                       const Cancelled& cancelled);

}  // namespace clearway
