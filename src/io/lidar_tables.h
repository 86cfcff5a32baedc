// The two tables of a LiDAR folder.
#pragma once

#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"
#include "io/row.h"

namespace clearway {

// Rows by ascending frame; stamps ascend too. Rows may come in any order; those that are bad, of a
// frame that has one already, or whose stamps do not ascend with the frames, are left out.
absl::StatusOr<std::vector<RecordedPose>> ReadLidarPoses(const std::filesystem::path& path,
                                                         LeftOut& left_out);

// Rows sorted by (frame, id). Rows that are bad, or of a frame without a pose, and second ones of a
// frame and track are left out.
absl::StatusOr<std::vector<RecordedBox>> ReadLidarBoxes(const std::filesystem::path& path,
                                                        const std::vector<RecordedPose>& poses,
                                                        LeftOut& left_out);

// What readers of such tables share.

// A pose with the line that it stands in.
struct TablePose {
  RecordedPose pose;
  int line = 0;
  int stamp_line = 0;  // of a table of stamps beside it
};
// Sorts by frames and leaves out second rows of a frame and the fewest others without which stamps
// ascend. `path` names the table, `times_path` that of the stamps if it is another.
std::vector<RecordedPose> InOrder(const std::filesystem::path& path, std::vector<TablePose> rows,
                                  LeftOut& left_out, const std::filesystem::path& times_path = {});

// Boxes of a table, by frame and id.
class BoxRows {
 public:
  // INVALID_ARGUMENT, naming both rows, if that frame has a box of that track.
  absl::Status Add(const Row& row, RecordedBox box);
  // By ascending (frame, id).
  std::vector<RecordedBox> Take();

 private:
  std::map<std::pair<int, ObjectId>, std::pair<int, RecordedBox>> boxes_;  // with their lines
};

}  // namespace clearway
