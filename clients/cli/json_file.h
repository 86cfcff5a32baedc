// JSON files that people write.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"
#include "cli/json.h"

namespace clearway::cli {

// INVALID_ARGUMENT naming line and column.
absl::StatusOr<Json> ParseJson(const std::string& text);

// The text of a file of at most 16 MB. NOT_FOUND calls it `kind` ("robot file") and adds `hint`.
absl::StatusOr<std::string> ReadTextFile(const std::filesystem::path& file, const std::string& kind,
                                         const std::string& hint = "");

}  // namespace clearway::cli
