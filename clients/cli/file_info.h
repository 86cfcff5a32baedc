// What `clearway info` says of each kind of input.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "cli/json.h"
#include "cli/open_source.h"

namespace clearway::cli {

// The same facts twice: for people, and for programs.
struct FileInfo {
  std::string text;
  Json json;
};

absl::StatusOr<FileInfo> InfoOfRecording(const std::string& path, const SourceFlags& flags);
absl::StatusOr<FileInfo> InfoOfLidarFolder(const std::string& path, const SourceFlags& flags);
absl::StatusOr<FileInfo> InfoOfOctomap(const std::string& path);
absl::StatusOr<FileInfo> InfoOfSimulation(const std::string& spec, const SourceFlags& flags);

}  // namespace clearway::cli
