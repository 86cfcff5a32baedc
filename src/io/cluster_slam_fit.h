// Whether poses and landmarks of a sequence of the ClusterSLAM dataset agree.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "io/cluster_slam_files.h"

namespace clearway {

// A landmark that both cameras see.
struct ClusterPoint {
  int landmark = 0;
  ObjectId label = kStaticLabel;
  Eigen::Vector3d p_S;
  Eigen::Vector2d left;  // pixels
};
using ClusterPoints = std::vector<ClusterPoint>;  // by ascending landmarks

// How far landmarks are seen from where they should be by the poses of their clusters, in pixels:
// the median over a sample. None where there are too few to tell.
struct ClusterFit {
  QuaternionOrder order = QuaternionOrder::kWFirst;
  std::optional<double> static_px, moving_px;
};

// Compares up to 20 pairs of frames, spread over the sequence. The order is kWFirst unless the
// other one fits twice as well. `points_of` reads a frame.
absl::StatusOr<ClusterFit> FitOf(
    const ClusterPoses& poses, const StereoPair& cameras,
    const std::function<absl::StatusOr<ClusterPoints>(int frame)>& points_of);

}  // namespace clearway
