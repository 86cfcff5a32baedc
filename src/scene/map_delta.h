// The part of a delta on one map.
#pragma once

#include <functional>
#include <string>

#include "absl/status/status.h"
#include "clearway/scene/scene_delta.h"

namespace clearway {

MapDelta DiffMaps(const VoxelMap& from, const VoxelMap& to, MapDetail detail);
// The same block by block, as long as `take` is true; returns whether it always was.
bool DiffMaps(const VoxelMap& from, const VoxelMap& to, MapDetail detail,
              const std::function<bool(BlockDelta)>& take);

// INVALID_ARGUMENT naming what of `field` is not well formed; the map is then of no use.
absl::Status ApplyMap(const std::string& field, const MapDelta& delta, VoxelMap& map);

}  // namespace clearway
