// A small sequence in the layout of the ClusterSLAM dataset.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/io/cluster_slam.h"
#include "support/temporary_folder.h"

namespace clearway {

inline constexpr char kClusterCameras[] =
    "500 0 320 0\n0 500 240 0\n0 0 1 0\n\n500 0 320 -250\n0 500 240 0\n0 0 1 0\n";

// Eight frames of a camera that goes along its z and turns; cluster 1 crosses before it, turning,
// and cluster 2 is nowhere to be seen. Landmarks 100 to 119 are static, 200 to 211 cluster 1's.
class ClusterSlam : public testing::Test {
 protected:
  static constexpr int kFrames = 8, kStatic = 20, kMoving = 12;

  ClusterSlam() { Write(); }

  static Pose Camera(int k) {
    return {
        Eigen::Quaterniond(Eigen::AngleAxisd(0.04 * k, Eigen::Vector3d(0.1, 1, 0).normalized())),
        {0.05 * k, -0.02 * k, 0.4 * k}};
  }
  static Pose Cluster(int k) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(0.9 + 0.1 * k, Eigen::Vector3d::UnitY())),
            {-2 + 0.5 * k, 0.3, 12}};
  }
  static Eigen::Vector3d StaticPoint_W(int i) {
    return {-4 + 0.45 * i, -1.5 + 0.3 * (i % 7), 8 + 1.1 * (i % 5)};
  }
  static Eigen::Vector3d MovingPoint_B(int i) {
    return {-1 + 0.2 * i, -0.5 + 0.25 * (i % 4), 0.3 * (i % 3)};
  }

  // With quaternions as the page has them, or as they were found in the files.
  void Write(
      bool w_first = true,
      const std::function<Pose(int)>& cluster = [](int k) { return Cluster(k); }) {
    folder_.Write("intrinsic.txt", kClusterCameras);
    std::string mapping;
    for (int i = 0; i < kStatic; ++i) absl::StrAppend(&mapping, 100 + i, " 0\n");
    for (int i = 0; i < kMoving; ++i) absl::StrAppend(&mapping, 200 + i, " 1\n");
    folder_.Write("landmark_mapping.txt", mapping);
    for (int k = 0; k < kFrames; ++k) {
      const std::string name = absl::StrFormat("%04d.txt", k);
      folder_.Write("pose/" + name, Line(Camera(k), w_first) + Line(cluster(k), w_first) +
                                        Line(Pose::Translation(0, 0, -90), w_first));
      folder_.Write("landmarks/left/" + name, Seen(k, 0));
      folder_.Write("landmarks/right/" + name, Seen(k, 0.5));
    }
  }
  absl::StatusOr<LidarFolder> Open(const ClusterSlamOptions& options = {}) {
    return OpenClusterSlam(folder_.path(), options);
  }

  TemporaryFolder folder_;

 private:
  static std::string Line(const Pose& pose, bool w_first) {
    const Eigen::Vector3d& p = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    const std::string vector = absl::StrFormat("%.9f %.9f %.9f", q.x(), q.y(), q.z());
    const std::string w = absl::StrFormat("%.9f", q.w());
    return absl::StrFormat("%.9f %.9f %.9f ", p.x(), p.y(), p.z()) +
           (w_first ? w + " " + vector : vector + " " + w) + "\n";
  }
  // By a camera that is so far to the right.
  static std::string Seen(int k, double right_m) {
    std::string text;
    const auto add = [&](int landmark, const Eigen::Vector3d& p_W) {
      const Eigen::Vector3d p = Inverse(Camera(k)) * p_W - Eigen::Vector3d(right_m, 0, 0);
      absl::StrAppendFormat(&text, "%d %.5f %.5f\n", landmark, 320 + 500 * p.x() / p.z(),
                            240 + 500 * p.y() / p.z());
    };
    for (int i = 0; i < kStatic; ++i) add(100 + i, StaticPoint_W(i));
    for (int i = 0; i < kMoving; ++i) add(200 + i, Cluster(k) * MovingPoint_B(i));
    return text;
  }
};

}  // namespace clearway
