#include "server/map_export.h"

#include "absl/strings/str_cat.h"
#include "clearway/io/flatten_scene.h"
#include "clearway/io/octomap_file.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Binary little-endian PLY of the occupied voxels' centres.
std::string PlyOf(const VoxelMap& map) {
  std::string ply =
      absl::StrCat("ply\nformat binary_little_endian 1.0\ncomment occupied voxels of ",
                   map.grid().resolution_m(), " m\nelement vertex ", map.occupied_count(),
                   "\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const Eigen::Vector3f center = map.grid().CenterOf(VoxelAt(key, index)).cast<float>();
      ply.append(reinterpret_cast<const char*>(center.data()), 3 * sizeof(float));
    });
  });
  return ply;
}

absl::StatusOr<VoxelMap> MapOf(const SceneSnapshot& scene, const ExportTarget& target) {
  if (const auto* object = std::get_if<ObjectTarget>(&target)) {
    const MovingObject* found = scene.FindObject(object->id);
    if (found != nullptr) return found->map_O;
    return WithReason(absl::NotFoundError(absl::StrCat("object_id: version ", scene.version,
                                                       " has no object ", object->id)),
                      "UNKNOWN_OBJECT");
  }
  if (const auto* at = std::get_if<SceneAtTarget>(&target)) {
    return FlattenScene(SceneAtTime(scene, at->time));
  }
  return scene.static_map_W;
}

}  // namespace

absl::StatusOr<std::string> ExportedFile(const SceneSnapshot& scene, const ExportTarget& target,
                                         MapFormat format) {
  absl::StatusOr<VoxelMap> map = MapOf(scene, target);
  if (!map.ok()) return map.status();
  if (format == MapFormat::kPly) return PlyOf(*map);
  return SerializeOctomap(*map,
                          format == MapFormat::kBt ? OctomapFormat::kBinary : OctomapFormat::kFull);
}

}  // namespace clearway
