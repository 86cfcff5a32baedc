// Poses over time, in the formats of the TUM RGB-D and the KITTI odometry benchmark.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

struct PoseRow {
  Time stamp;
  Pose pose;
};

struct PoseTable {
  std::vector<PoseRow> rows;  // at least one
  bool stamped = false;       // else stamps are those that were given for lack of others
};

// Lines of 8 words, TUM's "timestamp tx ty tz qx qy qz qw", or of 12, KITTI's matrices 3x4 row by
// row. Those have stamps if there is a times.txt beside them, of one line of seconds for each; else
// row k is at k times `period`. NOT_FOUND; INVALID_ARGUMENT names the line.
absl::StatusOr<PoseTable> ReadPoseTable(const std::filesystem::path& path, Duration period);

// KITTI's matrices, with the stamps of `times_path` if there is such a file.
absl::StatusOr<PoseTable> ReadKittiPoses(const std::filesystem::path& path,
                                         const std::filesystem::path& times_path, Duration period);

}  // namespace clearway
