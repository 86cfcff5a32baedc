#include "scene/scene_size.h"

#include "absl/strings/str_cat.h"

namespace clearway {

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
