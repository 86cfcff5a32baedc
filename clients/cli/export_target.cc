#include "cli/export_target.h"

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"

namespace clearway::cli {

absl::StatusOr<ExportArgument> ParseExportTarget(const std::string& text) {
  if (text == "static") return StaticMapTarget{};
  if (text == "scene") return SceneAtArgument{};
  ObjectId id = 0;
  if (text.starts_with("object:") && absl::SimpleAtoi(text.substr(7), &id) && id > 0) {
    return ObjectTarget{id};
  }
  if (text.starts_with("scene@")) {
    const auto time = ParseTime(text.substr(6));
    if (!time.ok()) return time.status();
    return SceneAtArgument{*time};
  }
  return absl::InvalidArgumentError(absl::StrCat(
      "expected static, object:ID, scene or scene@TIME (as scene@+1.5), not '", text, "'"));
}

absl::StatusOr<MapFormat> ParseMapFormat(const std::string& text) {
  if (text == "bt") return MapFormat::kBt;
  if (text == "ot") return MapFormat::kOt;
  if (text == "ply") return MapFormat::kPly;
  return absl::InvalidArgumentError(absl::StrCat("expected bt, ot or ply, not '", text, "'"));
}

}  // namespace clearway::cli
