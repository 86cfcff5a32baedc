// One shape of a robot file.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/robot.h"
#include "cli/json.h"

namespace clearway::cli {

// Reads {"type": ..., ...}; mesh files are looked for in `folder`. Errors name `path`'s fields.
absl::StatusOr<LinkShape> ParseLinkShape(const Json& value, const std::string& path,
                                         const std::filesystem::path& folder);

// "box:1,0.7,1", "sphere:0.3", "cylinder:0.3,1.2", "capsule:0.3,0.6".
absl::StatusOr<Shape> ParseShapeText(const std::string& text);

}  // namespace clearway::cli
