// Folders whose files are named by a frame's number.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// The files in the folder whose names are digits and that extension (".ply"), by their number,
// which is at most 99,999,999; leading zeros do not matter. Empty if there is no such folder.
// INVALID_ARGUMENT, naming both, if two files have one number.
absl::StatusOr<std::map<int, std::filesystem::path>> NumberedFiles(
    const std::filesystem::path& folder, const std::string& extension);

}  // namespace clearway
