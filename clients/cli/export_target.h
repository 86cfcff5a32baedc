// What `clearway export` is asked for.
#pragma once

#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "clearway/client/scene_client.h"
#include "cli/values.h"

namespace clearway::cli {

// The whole scene at a time that may be relative.
struct SceneAtArgument {
  TimeArgument time;
};
using ExportArgument = std::variant<StaticMapTarget, ObjectTarget, SceneAtArgument>;

// "static", "object:3", "scene" (now), "scene@+1.5", "scene@12.5".
absl::StatusOr<ExportArgument> ParseExportTarget(const std::string& text);

// "bt", "ot", "ply".
absl::StatusOr<MapFormat> ParseMapFormat(const std::string& text);

}  // namespace clearway::cli
