// The logs that one module of DynoSAM wrote.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Where a module's logs are: <folder>/<module>_camera_pose_log.csv and so on.
struct DynosamModule {
  std::filesystem::path folder;
  std::string name;

  std::filesystem::path Log(const char* what) const;  // "camera_pose"
};

// Of a folder with logs, or of a camera pose log itself. NOT_FOUND if there are none,
// INVALID_ARGUMENT, naming them, if the folder has those of several modules of which none is to be
// preferred.
absl::StatusOr<DynosamModule> FindDynosamModule(const std::filesystem::path& path);

// In each table bad rows, and second ones of a frame (and object), are left out.

// T_W_S by ascending frames and stamps. Stamps are the column timestamp, else those of
// frame_id_timestamp.csv, else a period for each number.
absl::StatusOr<std::vector<RecordedPose>> ReadDynosamCamera(const DynosamModule& module,
                                                            Duration period, LeftOut& left_out);

// By (frame, object): T_W_B of object_pose, or the motion of object_motion in W from the frame
// before.
using DynosamObjects = std::map<std::pair<int, ObjectId>, Pose>;
absl::StatusOr<DynosamObjects> ReadDynosamObjects(const std::filesystem::path& path,
                                                  LeftOut& left_out);

struct DynosamCloud {
  std::vector<Eigen::Vector3f> points_S;
  std::vector<ObjectId> labels;
};
struct DynosamPoints {
  std::map<int, DynosamCloud> clouds;       // by frame
  std::vector<Eigen::Vector3d> unframed_W;  // static, of no frame
  std::size_t without_pose = 0;             // of frames that have none, left out
};
absl::StatusOr<DynosamPoints> ReadDynosamPoints(const std::filesystem::path& path,
                                                const std::vector<RecordedPose>& poses,
                                                LeftOut& left_out);

}  // namespace clearway
