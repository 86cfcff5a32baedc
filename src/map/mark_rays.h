// Rays into a window of bits, each voxel with as little work as may be.
#pragma once

#include <span>

#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"
#include "map/ray_rounds.h"

namespace clearway {

// The blocks of all voxels that WalkRay visits on rays within the boxes, and some more.
struct BlockRange {
  BlockKey first, last;
};
BlockRange BlocksAround(const VoxelGrid& grid, const RayBoxes& boxes);

// Sets the bits of the voxels that WalkRay visits on the rays; the window must cover them.
// `one_origin`: whether all rays begin at one point, and have the same main axis and the same sign
// along it: first steps are skipped of such rays alone.
void MarkRays(const VoxelGrid& grid, const RayRounds& rays, bool one_origin, BitWindow& window);

// The same for rays of a few voxels each, of which neighbours are about as long: faster.
void MarkShortRays(const VoxelGrid& grid, std::span<const RaySegments> rays, BitWindow& window);

}  // namespace clearway
