// Scans in files that are named by their frame's number.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// The scans of one folder. A value.
class NumberedScans {
 public:
  // `digits` are those that names usually have. Errors of NumberedFiles.
  static absl::StatusOr<NumberedScans> In(const std::filesystem::path& folder,
                                          const std::string& extension, int digits);

  // With any number of leading zeros; the usual name if there is none.
  std::filesystem::path FileOf(int frame) const;

  // Leaves out the scans whose frames have no pose, and tells how many. `table` names that of the
  // poses.
  std::size_t LeaveOutUnposed(const std::vector<RecordedPose>& poses,
                              const std::filesystem::path& table, LeftOut& left_out) const;

 private:
  std::filesystem::path folder_;
  std::string extension_;
  int digits_ = 0;
  std::map<int, std::filesystem::path> files_;  // by frame
};

}  // namespace clearway
