// The two tables of a LiDAR folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Rows by ascending frame; stamps ascend too.
absl::StatusOr<std::vector<RecordedPose>> ReadLidarPoses(const std::filesystem::path& path);

// Rows sorted by (frame, id). Each row's frame must be one of `poses`.
absl::StatusOr<std::vector<RecordedBox>> ReadLidarBoxes(const std::filesystem::path& path,
                                                        const std::vector<RecordedPose>& poses);

// By (frame, id). INVALID_ARGUMENT, naming the file, if a frame has two boxes of one track.
absl::Status SortBoxes(const std::filesystem::path& path, std::vector<RecordedBox>& boxes);

}  // namespace clearway
