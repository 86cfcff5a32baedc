// The text files of a sequence of the ClusterSLAM dataset.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/geometry/pose.h"
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

// By frame: the camera's pose, then those of the clusters from 1 on; as many in each frame.
using ClusterPoses = std::map<int, std::vector<ClusterPose>>;
absl::StatusOr<ClusterPoses> ReadClusterPoses(const std::filesystem::path& folder);

// The cluster of each landmark.
using LandmarkClusters = std::map<int, ObjectId>;
absl::StatusOr<LandmarkClusters> ReadLandmarkClusters(const std::filesystem::path& path);

// Pixels of landmarks by their ids.
using Landmarks = std::map<int, Eigen::Vector2d>;
absl::StatusOr<Landmarks> ReadLandmarks(const std::filesystem::path& path);

// The two projection matrices of intrinsic.txt, which the page's list spells instrinsic.txt.
absl::StatusOr<StereoPair> ReadClusterCameras(const std::filesystem::path& folder);

}  // namespace clearway
