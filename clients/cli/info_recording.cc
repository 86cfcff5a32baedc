#include "absl/strings/str_cat.h"
#include "clearway/io/recording.h"
#include "clearway/report/table.h"
#include "cli/file_info.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

std::string AsText(const std::string& path, const RecordingInfo& info) {
  std::string text = absl::StrCat("recording   ", path, ", ", Bytes(info.file_bytes), "\n");
  if (!info.description.empty()) absl::StrAppend(&text, "what        ", info.description, "\n");
  absl::StrAppend(&text, "frames      ", Grouped(info.frames), " over ", Seconds(info.duration()),
                  ", stamps ", Seconds(info.first_stamp), " to ", Seconds(info.last_stamp), "\n",
                  "points      ", Grouped(info.points), "\n", "voxel size  ",
                  Fixed(info.resolution_m, 3), " m suits it\n");
  if (!info.origin_m.isZero(0)) {
    absl::StrAppend(&text, "origin      ", OriginText(info.origin_m), ", subtracted\n");
  }
  for (const auto& [sensor, frames] : info.sensors) {
    absl::StrAppend(&text, "sensor      ", sensor, ", ", Plural(frames, "frame"), "\n");
  }
  absl::StrAppend(&text, "objects     ", info.objects.size(), "\n");
  if (info.objects.empty()) return text;
  Table table({"id", "frames", "points", "motions or poses"});
  for (const auto& [id, object] : info.objects) {
    table.AddRow({absl::StrCat(id), Grouped(object.frames), Grouped(object.points),
                  Grouped(object.motions)});
  }
  return text + table.ToString();
}

Json AsJson(const std::string& path, const RecordingInfo& info) {
  Json json = {{"kind", "recording"},
               {"path", path},
               {"description", info.description},
               {"file_bytes", info.file_bytes},
               {"resolution_m", info.resolution_m},
               {"origin_m", ToJson(info.origin_m)},
               {"frames", info.frames},
               {"points", info.points},
               {"first_stamp_ns", ToNanoseconds(info.first_stamp)},
               {"last_stamp_ns", ToNanoseconds(info.last_stamp)},
               {"sensors", Json::array()},
               {"objects", Json::array()}};
  for (const auto& [sensor, frames] : info.sensors) {
    json["sensors"].push_back({{"sensor_id", sensor}, {"frames", frames}});
  }
  for (const auto& [id, object] : info.objects) {
    json["objects"].push_back({{"id", id},
                               {"frames", object.frames},
                               {"points", object.points},
                               {"motions_or_poses", object.motions}});
  }
  return json;
}

}  // namespace

absl::StatusOr<FileInfo> InfoOfRecording(const std::string& path, const SourceFlags& flags) {
  // Beyond the limit or not: what it holds is worth showing.
  if (auto status = CheckSourceFlags(flags, path, SourceFormat::kRecording); !status.ok()) {
    return status;
  }
  auto info = InspectRecording(path);
  if (!info.ok()) return info.status();
  if (flags.origin) {
    const auto moved = OpenSource(path, flags);
    if (!moved.ok()) return moved.status();
    info->origin_m = moved->origin_m;
  }
  return FileInfo{AsText(path, *info), AsJson(path, *info)};
}

}  // namespace clearway::cli
