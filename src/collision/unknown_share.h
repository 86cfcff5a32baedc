// How much of a robot lies in unknown space.
#pragma once

#include <vector>

#include "clearway/map/voxel_map.h"
#include "collision/center_masks.h"
#include "collision/narrowphase.h"
#include "collision/voxel_search.h"

namespace clearway {

// Of the static voxels whose centre lies in at least one of the shapes (placed in W), the share
// never observed, 0 to 1; voxels whose centre lies in one of the known_free boxes count as
// observed. A robot so small that no centre lies in it is judged by the voxels that hold its
// shapes' centres. The shapes must lie in the addressable space. Meaningless once `cancelled`.
double UnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                      const std::vector<const PlacedShape*>& shapes_W, const Cancelled& cancelled);

// At least what UnknownShareOf says wherever the shapes are on their ways and
// within their margins.
double MostUnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                          const std::vector<Sweep>& sweeps_W, const Cancelled& cancelled);

}  // namespace clearway
