#include "demo/scene_pictures.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/report/object_sheet.h"
#include "clearway/report/top_view.h"

namespace clearway::demo {

absl::Status DrawScene(const SceneSnapshot& scene, const Sequence& sequence,
                       const std::filesystem::path& folder) {
  TopViewOptions overview;
  overview.title =
      absl::StrCat(sequence.name, ": the map after ", sequence.frames.frame_count, " frames");
  overview.subtitle =
      absl::StrFormat("%d occupied voxels of %g m, %d objects", scene.static_map_W.occupied_count(),
                      scene.params.resolution_m, scene.objects.size());
  overview.names = sequence.object_names;
  overview.area_W = scene.static_map_W.OccupiedBox().Padded(2);
  const absl::Status status = WriteTopView(scene, overview, folder / "overview.png");
  if (!status.ok()) return status;
  ObjectSheetOptions sheet;
  sheet.title = absl::StrCat(sequence.name, ": objects as reconstructed");
  sheet.names = sequence.object_names;
  return WriteObjectSheet(scene, sheet, folder / "objects.png");
}

}  // namespace clearway::demo
