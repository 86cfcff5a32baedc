// Folders of point clouds, PCD or PLY, with a table of the sensor's poses.
#pragma once

#include <filesystem>
#include <limits>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

struct CloudFolderOptions {
  int first_frame = 0;  // as in LidarFolderOptions
  int last_frame = std::numeric_limits<int>::max();
  std::string sensor_id = "lidar";
  // The table of poses. Empty: the one file of a usual name in the folder, or beside it.
  std::filesystem::path pose_table = {};
  // The field of each point's label: 0 static, below 0 or NaN to be left out, else an object's id.
  // Empty: all points are static.
  std::string label_field = {};
  // Of tables without stamps, if there is no times.txt either.
  Duration frame_period = std::chrono::milliseconds(100);
};

// Whether clouds (.pcd, .ply) are in the folder, or in one folder in it.
bool IsCloudFolder(const std::filesystem::path& folder);

// Reads the table; clouds are read with each frame. The table is in TUM's format (stamp, position,
// quaternion) or KITTI's (3x4 matrices), each row T_W_S of one sensor pose. Names of clouds that
// are stamps get the pose at that time, other numbers the row of that number, other names the rows
// in their order: docs/formats.md has the details. Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenCloudFolder(const std::filesystem::path& folder,
                                            const CloudFolderOptions& options = {});

}  // namespace clearway
