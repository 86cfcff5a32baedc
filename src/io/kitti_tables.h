// The text files of KITTI's tracking benchmark: words between blanks.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Frames: S velodyne, I IMU, C rectified camera 0 (x right, y down, z forward).
struct KittiCalibration {
  Pose T_C_S, T_S_I;
  Eigen::Matrix<double, 3, 4> image_from_C;  // P2, of the left colour camera, in pixels
};
absl::StatusOr<KittiCalibration> ReadKittiCalibration(const std::filesystem::path& path);

// T_W_I, a line for each frame; a frame whose line is bad or empty has none.
absl::StatusOr<std::vector<std::optional<Pose>>> ReadKittiOxts(const std::filesystem::path& path,
                                                               LeftOut& left_out);

// In pixels of the left colour image.
struct ImageRegion {
  double left, top, right, bottom;
};
// A track's box at a frame, in C.
struct KittiBox {
  int line = 0;
  int frame = 0;
  int track = 0;
  std::string type;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // length, width, height
  Pose T_C_B;                                        // as RecordedBox's B
};
struct KittiLabels {
  std::vector<KittiBox> boxes;
  std::multimap<int, ImageRegion> unlabelled;  // DontCare, by frame
};
// Bad rows, and second ones of a frame and track, are left out.
absl::StatusOr<KittiLabels> ReadKittiLabels(const std::filesystem::path& path, LeftOut& left_out);

}  // namespace clearway
