// A scene as one map.
#pragma once

#include <cstdint>
#include <functional>

#include "absl/status/statusor.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// The static map with everything else that blocks at the scene's time written into it as occupied:
// voxels whose centre an object's solid fills or, beyond the horizon, may have been reached by it
// (a map has no other word for that), voxels that hold the centre of an object's occupied voxel,
// and keep-out zones, as far as they lie in the box of all that is known. Everything else keeps the
// static map's state. RESOURCE_EXHAUSTED if more than max_voxels would have to be looked at;
// CANCELLED soon after `cancelled`, which is asked every so often, has become true.
absl::StatusOr<VoxelMap> FlattenScene(
    const SceneAtTime& scene, std::int64_t max_voxels = std::int64_t{1} << 28,
    const std::function<bool()>& cancelled = [] { return false; });

}  // namespace clearway
