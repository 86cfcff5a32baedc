// Poses over time, in the formats of the TUM RGB-D and the KITTI odometry benchmark.
#pragma once

#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "io/lidar_tables.h"

namespace clearway {

struct PoseTable {
  // In the file's order, with row numbers from 0 as frames; rows that are left out count, too.
  // Stamps may come in any order.
  std::vector<TablePose> rows;
  std::size_t row_count = 0;
  bool stamped = false;                   // else row k is at k times the period that was given
  std::filesystem::path times_path = {};  // of the stamps, if it is another file
};

// Lines of 8 words, TUM's "timestamp tx ty tz qx qy qz qw", or of 12, KITTI's matrices 3x4 row by
// row. Those have stamps if there is a times.txt beside them, of one line of seconds for each; else
// row k is at k times `period`. NOT_FOUND; INVALID_ARGUMENT names the line; bad rows are left out.
absl::StatusOr<PoseTable> ReadPoseTable(const std::filesystem::path& path, Duration period,
                                        LeftOut& left_out);

// KITTI's matrices, with the stamps of `times_path` if there is such a file.
absl::StatusOr<PoseTable> ReadKittiPoses(const std::filesystem::path& path,
                                         const std::filesystem::path& times_path, Duration period,
                                         LeftOut& left_out);

}  // namespace clearway
