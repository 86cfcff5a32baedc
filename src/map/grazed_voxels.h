// Voxels that a scan's rays only graze.
#pragma once

#include <span>

#include "clearway/base/thread_pool.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"
#include "map/passed_voxels.h"

namespace clearway {

// Takes from the update of a map the misses that RayOptions::grazing_m speaks of. `rays`: those of
// the scan that end on something, in the map's frame. The result does not depend on the number of
// threads. `stretches`: memory to work in.
void SpareGrazed(const VoxelMap& map, std::span<const RaySegment> rays, double grazing_m,
                 ThreadPool& pool, PassedVoxels& stretches, ScanUpdate& update);

}  // namespace clearway
