// A scan's hits and misses in one block.
#pragma once

#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_block.h"

namespace clearway {

// One hit or one miss for each marked voxel; a hit beats a miss, and an end voxel without a hit
// stays as it is.
void ApplyScan(const ScanUpdate::Block& scan, const OccupancyModel& model, VoxelBlock& block);

}  // namespace clearway
