// Poses for a folder's point clouds, from a table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "io/cloud_names.h"
#include "io/lidar_tables.h"
#include "io/pose_table.h"

namespace clearway {

// The clouds that become frames.
struct PosedClouds {
  std::map<int, std::filesystem::path> clouds;  // by the frame's number
  std::vector<RecordedPose> poses;              // of the same frames, ascending
  std::string how;                              // clouds got their poses
  std::size_t without_pose = 0;
};

// Clouds that their stamps name get the pose at that stamp, others that of their row. Clouds
// without a usable pose are left out. INVALID_ARGUMENT if it is not clear which row is whose, or if
// no cloud has a pose; the message says how the names were read.
absl::StatusOr<PosedClouds> PoseClouds(const NamedClouds& named, const PoseTable& table,
                                       const std::filesystem::path& table_path,
                                       const std::filesystem::path& folder, LeftOut& left_out);

}  // namespace clearway
