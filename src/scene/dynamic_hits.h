// How movers that nobody labelled are kept from being burnt into the static map.
#pragma once

#include <vector>

#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/dynamic_space.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The static map as it is known for long: dynamic space is free in it, as it was before.
VoxelMap WithoutDynamic(VoxelMap static_map_W, const DynamicSpace& dynamic_W);

// What a scan makes of dynamic space.
struct DynamicChange {
  std::vector<DynamicVoxel> voxels;  // in DynamicSpace's order
  std::vector<VoxelKey> settled;     // hit for so long that they are static after all
  std::vector<VoxelKey> lost;        // not looked at for so long that nobody knows
};

// Takes the hits on what was known free for long out of the update, unless they are new single ones
// or new ones next to a surface, where they come of noise. What the update's rays pass is dynamic
// no more, nor is what the map has forgotten since. `lasting_W`: the static map before the scan,
// WithoutDynamic.
DynamicChange TakeDynamicHits(const VoxelMap& lasting_W, const DynamicSpace& dynamic_W, Time stamp,
                              const SceneParams& params, ScanUpdate& update);

// Puts the change into the static map after the scan, and returns what is dynamic in it.
DynamicSpace PutDynamic(DynamicChange change, VoxelMap& static_map_W);

// Dynamic space without what another map has observed: that is known by now.
DynamicSpace WithoutObserved(const DynamicSpace& dynamic_W, const VoxelMap& map_W);

// Dynamic space without what the static map has forgotten.
DynamicSpace StillIn(const VoxelMap& static_map_W, const DynamicSpace& dynamic_W);

}  // namespace clearway
