#include "scene/scene_size.h"

#include "absl/strings/str_cat.h"

namespace clearway {

absl::Status CheckRays(const VoxelGrid& grid, const RayCloud& rays, const RayOptions& options,
                       const FrameLimits& limits) {
  const double voxels = VoxelsPassed(grid, rays, options);
  if (voxels <= static_cast<double>(limits.max_ray_voxels)) return absl::OkStatus();
  return absl::ResourceExhaustedError(absl::StrCat(
      "points_m: the rays pass ", static_cast<std::uint64_t>(voxels), " voxels; the limit is ",
      limits.max_ray_voxels, "; give the scene a max_range_m, or larger voxels"));
}

std::size_t BlocksOf(const SceneObjects& objects, const SceneObjects& dropped_lately,
                     const Surroundings& around_objects) {
  std::size_t blocks = 0;
  for (const auto& [id, around_O] : around_objects) blocks += around_O.blocks().size();
  for (const auto& object : objects) blocks += object->map_O.blocks().size();
  for (const auto& object : dropped_lately) blocks += object->map_O.blocks().size();
  return blocks;
}

absl::Status CheckBlocks(const std::string& field, std::size_t blocks, const FrameLimits& limits) {
  if (blocks <= limits.max_blocks) return absl::OkStatus();
  return absl::ResourceExhaustedError(absl::StrCat(
      field, ": the scene's maps would hold ", blocks, " blocks; the limit is ", limits.max_blocks,
      "; give the scene a keep_distance_m or a higher limit max_blocks"));
}

}  // namespace clearway
