// Sequences of the ClusterSLAM dataset: stereo landmarks of static and moving things.
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

struct ClusterSlamOptions {
  // As in LidarFolderOptions; frames are numbered as the files.
  LidarObjects objects = LidarObjects::kMotions;
  Duration motions_over = Duration::zero();
  int first_frame = 0;
  int last_frame = std::numeric_limits<int>::max();
  bool allow_missing_points = false;
  std::string sensor_id = "camera";
  // Between a frame and the next number's: the dataset has no stamps. At most 10 s.
  Duration frame_period = std::chrono::milliseconds(100);
  std::optional<double> max_depth_m = std::nullopt;  // what is farther along z is left out
};

// Whether the folder has a landmark_mapping.txt and a folder pose.
bool IsClusterSlam(const std::filesystem::path& folder);

// Reads intrinsic.txt, landmark_mapping.txt, pose/NNNN.txt and landmarks/left and right/NNNN.txt
// (https://huangjh-pub.github.io/page/clusterslam-dataset/; Huang et al., "ClusterSLAM: A SLAM
// Backend for Simultaneous Rigid Body Clustering and Motion Estimation", 2019). Images and shapes
// are not read. S is the left camera's optical frame: x right, y down, z forward.
//
// A landmark that both cameras see is a point, triangulated; its label is its cluster's id, of
// which 0 is static. Those too far for one pixel of disparity are left out. Poses of clusters
// become `boxes` without a size.
//
// The page has quaternions as x, y, z, w; DynoSAM, which reads the files
// (dynosam/src/dataprovider/ClusterSlamDataProvider.cc), found w, x, y, z in them. So the order is
// that with which static landmarks stay where they are: a sample of them, moved by the poses of two
// frames, is projected into the second and compared with what was seen there. INVALID_ARGUMENT if
// neither fits (a median above 10 pixels), if landmarks of moving clusters do not go with their
// poses, unless `objects` is kNone, or if of those that both cameras see none lies before them.
// `description` tells the order, the medians and what has no poses. Other errors as
// OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenClusterSlam(const std::filesystem::path& folder,
                                            const ClusterSlamOptions& options = {});

}  // namespace clearway
