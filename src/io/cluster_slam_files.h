// The text files of a sequence of the ClusterSLAM dataset.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/geometry/pose.h"
#include "clearway/io/left_out.h"
#include "clearway/scene/frame.h"
#include "io/stereo_pair.h"

namespace clearway {

// Which of a pose's four last numbers is the quaternion's w.
enum class QuaternionOrder { kWFirst, kWLast };

// T_W_S or T_W_B as it is written.
struct ClusterPose {
  Eigen::Vector3d translation;
  Eigen::Vector4d quaternion;  // of length 1

  Pose In(QuaternionOrder order) const;
};

// The poses of one frame; none where the row is bad.
struct ClusterFrame {
  ClusterPose camera;
  std::vector<std::optional<ClusterPose>> clusters;  // by id, from 1 on
};
// By frame; as many clusters in each. Frames without a pose of the camera, or with another number
// of rows than most, are left out: a row's number is its cluster's id.
using ClusterPoses = std::map<int, ClusterFrame>;
absl::StatusOr<ClusterPoses> ReadClusterPoses(const std::filesystem::path& folder,
                                              LeftOut& left_out);

// In these two tables bad rows, and second ones of a landmark, are left out.

// The cluster of each landmark.
using LandmarkClusters = std::map<int, ObjectId>;
absl::StatusOr<LandmarkClusters> ReadLandmarkClusters(const std::filesystem::path& path,
                                                      LeftOut& left_out);

// Pixels of landmarks by their ids.
using Landmarks = std::map<int, Eigen::Vector2d>;
absl::StatusOr<Landmarks> ReadLandmarks(const std::filesystem::path& path, LeftOut& left_out);

// The two projection matrices of intrinsic.txt, which the page's list spells instrinsic.txt.
absl::StatusOr<StereoPair> ReadClusterCameras(const std::filesystem::path& folder);

}  // namespace clearway
