// A scan's hits and misses in one block.
#pragma once

#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_block.h"

namespace clearway {

// Makes `after` the block `before` with one hit or one miss for each marked voxel; a hit beats a
// miss, and an end voxel without a hit stays as it is. Returns whether anything differs.
bool ApplyScan(const ScanUpdate::Block& scan, const OccupancyModel& model, const VoxelBlock& before,
               VoxelBlock& after);

}  // namespace clearway
