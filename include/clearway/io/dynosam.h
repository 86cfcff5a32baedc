// What the Dynamic SLAM system DynoSAM logged.
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

struct DynosamOptions {
  // As in LidarFolderOptions, but motions are those of the log, from the frame before.
  LidarObjects objects = LidarObjects::kMotions;
  int first_frame = 0;  // by the number in the logs; both ends belong to the range
  int last_frame = std::numeric_limits<int>::max();
  bool allow_missing_points = false;  // go on without a log of points
  std::string sensor_id = "camera";
  // Between a frame and the next number's, where the logs hold no stamps. At most 10 s.
  Duration frame_period = std::chrono::milliseconds(100);
};

// Whether the path is a folder with a *_camera_pose_log.csv, or such a file.
bool IsDynosam(const std::filesystem::path& path);

// Reads the logs that one module of DynoSAM ("frontend", "rgbd_motion_world_backend") wrote: a
// camera pose log, object pose and motion logs, map points. Of a folder with several modules the
// one that is not the front end is taken; a camera pose log names its module.
//
// S is the camera's optical frame (x right, y down, z forward), W that of the logs, in which
// gravity has no fixed direction. Motions are H_W from frame k-1 to k. Points are given in W, and
// brought into S; object_id 0 is static. A back end says of no static point which frame saw it:
// those come with the first frame of the range, each as a ray of length 0, which hits its voxel and
// clears nothing. Object poses become `boxes` without a size.
//
// As the repository ACFR-RPG/DynOSAM writes them: README.md, "Output logs"; the headers in
// dynosam/src/logger/Logger.cc and, with the column timestamp, dynosam_common/src/logger/Logger.cc;
// frames of points in dynosam/include/dynosam/backend/Accessor-impl.hpp and
// dynosam_common/include/dynosam_common/Types.hpp; motions in
// dynosam/include/dynosam/common/GroundTruthPacket.hpp. Line ends are those of
// dynosam_common/src/utils/CsvParser.cc in its fork eunseon02/DynOSAM. docs/formats.md has it all.
//
// Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenDynosam(const std::filesystem::path& path,
                                        const DynosamOptions& options = {});

}  // namespace clearway
