// Where the real recordings are that some tests read.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>

namespace clearway {

// The folder of real recordings: the environment's CLEARWAY_DATA, else `../shared/data` beside the
// source tree. None, with a message that says where it was looked for, if there is no such folder:
// the data's licences keep it out of the repository. A test then checks data of its own, or skips.
inline std::optional<std::filesystem::path> DataFolder() {
  const char* const variable = std::getenv("CLEARWAY_DATA");
  const std::filesystem::path folder =
      variable != nullptr && *variable != '\0'
          ? std::filesystem::path(variable)
          : std::filesystem::path(CLEARWAY_SOURCE_DIR) / ".." / "shared" / "data";
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return folder;
  std::cerr << "[  MISSING ] no real recordings at " << folder
            << " (set CLEARWAY_DATA to their folder)\n";
  return std::nullopt;
}

// The same for one file or folder of it, for example "kitti0000_fov" or "octomap/geb079.bt".
inline std::optional<std::filesystem::path> DataPath(const std::string& relative) {
  const std::optional<std::filesystem::path> folder = DataFolder();
  if (!folder) return std::nullopt;
  std::error_code error;
  if (std::filesystem::exists(*folder / relative, error)) return *folder / relative;
  std::cerr << "[  MISSING ] no " << relative << " in " << *folder << "\n";
  return std::nullopt;
}

}  // namespace clearway
