#include "server/map_export.h"

#include "absl/strings/str_cat.h"
#include "clearway/io/flatten_scene.h"
#include "clearway/io/octomap_file.h"
#include "clearway/io/ply.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::int64_t kMaxFlatVoxels = std::int64_t{1} << 28;

absl::StatusOr<const MovingObject*> FindObject(const SceneSnapshot& scene, ObjectId id) {
  if (const MovingObject* found = scene.FindObject(id)) return found;
  return WithReason(absl::NotFoundError(
                        absl::StrCat("object_id: version ", scene.version, " has no object ", id)),
                    "UNKNOWN_OBJECT");
}

absl::StatusOr<VoxelMap> MapOf(const SceneSnapshot& scene, const ExportTarget& target,
                               const Gone& gone) {
  if (const auto* at = std::get_if<SceneAtTarget>(&target)) {
    return FlattenScene(SceneAtTime(scene, at->time), kMaxFlatVoxels, gone);
  }
  if (const auto* object = std::get_if<ObjectTarget>(&target)) {
    absl::StatusOr<const MovingObject*> found = FindObject(scene, object->id);
    if (!found.ok()) return found.status();
    return (*found)->map_O;
  }
  return scene.LastingMap();
}

// The static map or one object alone, in its own frame; the scene with its objects in colours.
absl::Status WriteAsPly(const SceneSnapshot& scene, const ExportTarget& target,
                        const ByteSink& sink) {
  const VoxelMap lasting_W = scene.LastingMap();
  std::vector<PlyLayer> layers;
  if (const auto* at = std::get_if<SceneAtTarget>(&target)) {
    layers.push_back({&scene.static_map_W, {}, kStaticLabel, PlyColorOf(kStaticLabel)});
    const SceneAtTime placed_scene(scene, at->time);
    for (const SceneAtTime::Placed& placed : placed_scene.objects()) {
      const ObjectId id = placed.object->id;
      layers.push_back({&placed.object->map_O, placed.T_W_O, id, PlyColorOf(id)});
    }
  } else if (const auto* object = std::get_if<ObjectTarget>(&target)) {
    absl::StatusOr<const MovingObject*> found = FindObject(scene, object->id);
    if (!found.ok()) return found.status();
    layers.push_back({&(*found)->map_O, {}, object->id, PlyColorOf(object->id)});
  } else {
    layers.push_back({&lasting_W, {}, kStaticLabel, PlyColorOf(kStaticLabel)});
  }
  return WritePly(layers, PlyStyle::kPoints, sink);
}

}  // namespace

absl::Status ExportTo(const ByteSink& sink, const SceneSnapshot& scene, const ExportTarget& target,
                      MapFormat format, const Gone& gone) {
  if (format == MapFormat::kPly) return WriteAsPly(scene, target, sink);
  absl::StatusOr<VoxelMap> map = MapOf(scene, target, gone);
  if (!map.ok()) return map.status();
  const OctomapFormat octomap =
      format == MapFormat::kBt ? OctomapFormat::kBinary : OctomapFormat::kFull;
  return WriteOctomap(*map, octomap, sink, gone);
}

}  // namespace clearway
