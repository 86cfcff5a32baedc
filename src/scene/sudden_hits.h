// Hits where long nothing was.
#pragma once

#include <vector>

#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/dynamic_space.h"

namespace clearway {

// The update's hits on voxels that are as free as the map can know them to be, in DynamicSpace's
// order: those that are dynamic already, and those that may be new: with two more at most two
// voxels away along each axis, and no surface as near, where they come of noise. `lasting_W`: the
// static map before the scan, WithoutDynamic.
std::vector<VoxelKey> SuddenHits(const VoxelMap& lasting_W, const DynamicSpace& dynamic_W,
                                 const ScanUpdate& update);

}  // namespace clearway
