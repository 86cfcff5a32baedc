// What folders of LiDAR scans have in common, whatever the format of their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// The tables of a folder, and how its points are read. A value.
struct LidarScans {
  std::string name;  // for messages
  LidarFolderOptions options;
  std::vector<RecordedPose> poses;  // ascending frames, not empty
  std::vector<RecordedBox> boxes;   // ascending (frame, id)
  bool of_gps = false;              // the poses are of GPS and inertial sensors
  // `read` sets motions; those between boxes are added over gaps of the boxes' frames alone.
  bool has_motions = false;
  std::shared_ptr<LeftOut> left_out = std::make_shared<LeftOut>();  // as FrameSource's
  // The file of a frame's points.
  std::function<std::filesystem::path(int frame)> points_of;
  // Sets points and labels of a frame whose boxes these are, and motions if has_motions. Any
  // thread.
  std::function<absl::Status(const std::filesystem::path& points,
                             std::span<const RecordedBox> boxes, Frame& frame)>
      read;
};

// The pose of a frame; null if there is none.
const RecordedPose* PoseOf(const std::vector<RecordedPose>& poses, std::int64_t frame);

// Of sources without stamps: INVALID_ARGUMENT if it is not above 0, or above 10 s.
absl::Status CheckFramePeriod(Duration period);

// The frames of the options' range. INVALID_ARGUMENT if there are none, NOT_FOUND if points are
// missing and may not.
absl::StatusOr<LidarFolder> FramesOf(LidarScans scans);

}  // namespace clearway
