// Rays into a window of bits, each voxel with as little work as may be.
#pragma once

#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"
#include "map/ray_rounds.h"

namespace clearway {

// Sets the bits of the voxels that WalkRay visits on the rays; the window must cover them.
void MarkRays(const VoxelGrid& grid, const RayRounds& rays, BitWindow& window);

}  // namespace clearway
