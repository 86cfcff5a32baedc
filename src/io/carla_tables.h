// The tables beside scans of the simulator CARLA: where its sensor and its actors were.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// CARLA's frames are left-handed: x forward, y right, z up.
struct CarlaTransform {
  Eigen::Vector3d location_m = Eigen::Vector3d::Zero();
  // To the right is +yaw, nose up +pitch, right side down +roll.
  double roll_deg = 0, pitch_deg = 0, yaw_deg = 0;
};

// The same place in frames with y to the left. Coordinates and both frames are mirrored
// (x, -y, z), which turns the signs of yaw and pitch: Docs/coordinate_conventions.md of CARLA.
Pose FromCarla(const CarlaTransform& transform);

// T_W_S by ascending frames and stamps; other rows are left out as by ReadLidarPoses.
absl::StatusOr<std::vector<RecordedPose>> ReadCarlaSensor(const std::filesystem::path& path,
                                                          LeftOut& left_out);

struct CarlaActors {
  std::vector<RecordedBox> boxes;  // ascending (frame, id)
  std::set<ObjectId> objects;      // all that have a row
  std::set<ObjectId> ego;          // of the type "ego": what the sensor is mounted on
  std::size_t without_pose = 0;    // rows of frames that the sensor has none of
};
absl::StatusOr<CarlaActors> ReadCarlaActors(const std::filesystem::path& path,
                                            const std::vector<RecordedPose>& poses,
                                            LeftOut& left_out);

}  // namespace clearway
