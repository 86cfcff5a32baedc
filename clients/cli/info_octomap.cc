#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "clearway/base/number_text.h"
#include "clearway/io/octomap_file.h"
#include "cli/file_info.h"
#include "cli/text.h"

namespace clearway::cli {

absl::StatusOr<FileInfo> InfoOfOctomap(const std::string& path) {
  const auto file = ReadOctomap(path);
  if (!file.ok()) return file.status();
  const VoxelMap& map = file->map;
  const bool full = file->format == OctomapFormat::kFull;
  const auto free = static_cast<std::uint64_t>(map.observed_count() - map.occupied_count());
  const Aabb box = map.ObservedBox();

  FileInfo info;
  info.text = absl::StrCat("map         ", path, ": ", file->tree_type,
                           full ? ", log-odds (.ot)" : ", three-way (.bt)", "\n", "voxel size  ",
                           NumberText(map.grid().resolution_m()), " m\n", "voxels      ",
                           Grouped(map.occupied_count()), " occupied, ", Grouped(free), " free\n");
  if (!box.Empty()) {
    absl::StrAppend(&info.text, "extent      ", Size(box.Size()), ", from ", Point(box.min), " to ",
                    Point(box.max), "\n");
  }
  if (file->clamped_voxels > 0) {
    absl::StrAppend(&info.text, "clamped     ", Plural(file->clamped_voxels, "voxel"),
                    " had log-odds beyond the sensor model's limits\n");
  }
  if (!file->unknown_keys.empty()) {
    absl::StrAppend(&info.text, "header      skipped: ", absl::StrJoin(file->unknown_keys, ", "),
                    " (not known to OctoMap)\n");
  }
  info.json = {{"kind", "octomap"},
               {"path", path},
               {"tree_type", file->tree_type},
               {"format", full ? "ot" : "bt"},
               {"resolution_m", map.grid().resolution_m()},
               {"occupied_voxels", map.occupied_count()},
               {"free_voxels", free},
               {"clamped_voxels", file->clamped_voxels},
               {"unknown_header_keys", file->unknown_keys},
               {"box", ToJson(box)}};
  return info;
}

}  // namespace clearway::cli
