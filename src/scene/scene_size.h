// What the rays of a frame may cost, and how many blocks the maps of a scene may hold.
#pragma once

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "clearway/map/ray.h"
#include "clearway/map/voxel_key.h"
#include "clearway/scene/frame.h"
#include "scene/given_object.h"
#include "scene/surroundings.h"

namespace clearway {

// RESOURCE_EXHAUSTED for rays through more than FrameLimits::max_ray_voxels, before they are
// walked.
absl::Status CheckRays(const VoxelGrid& grid, const RayCloud& rays, const RayOptions& options,
                       const FrameLimits& limits);

// In all maps beside the static one.
std::size_t BlocksOf(const SceneObjects& objects, const SceneObjects& dropped_lately,
                     const Surroundings& around_objects);

// RESOURCE_EXHAUSTED for more than FrameLimits::max_blocks; `field` names what would make them.
absl::Status CheckBlocks(const std::string& field, std::size_t blocks, const FrameLimits& limits);

}  // namespace clearway
