// Text files that people write, most of them JSON.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "absl/status/statusor.h"
#include "cli/json.h"

namespace clearway::cli {

// INVALID_ARGUMENT naming line and column, or the key that an object has twice.
absl::StatusOr<Json> ParseJson(const std::string& text);

// The text of a file of at most 16 MB, without a byte order mark. NOT_FOUND calls it `kind` ("robot
// file") and adds `hint`; INVALID_ARGUMENT says what a file that is no text is.
absl::StatusOr<std::string> ReadTextFile(const std::filesystem::path& file, const std::string& kind,
                                         const std::string& hint = "");

// All that a stream still holds, at most 16 MB.
absl::StatusOr<std::string> ReadStream(const std::string& name, std::istream& in);

}  // namespace clearway::cli
