#include "io/cluster_slam_files.h"

#include <cmath>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/numbered_files.h"
#include "io/word_lines.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

absl::StatusOr<ClusterPose> ReadPose(Words& line) {
  constexpr double kUnitTolerance = 0.01;
  if (line.size() != 7) return WrongCount(line, "x y z and a quaternion");
  ClusterPose pose;
  for (int i = 0; i < 3; ++i) pose.translation[i] = line.Number(i);
  for (int i = 0; i < 4; ++i) pose.quaternion[i] = line.Number(3 + i);
  if (!line.status().ok()) return line.status();
  const double length = pose.quaternion.norm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    return absl::InvalidArgumentError(
        absl::StrCat(line.where(), ", words 4 to 7: no unit quaternion, its length is ", length));
  }
  pose.quaternion /= length;
  return pose;
}

absl::StatusOr<std::vector<ClusterPose>> ReadFramePoses(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  std::vector<ClusterPose> poses;
  for (Words& line : *lines) {
    const auto pose = ReadPose(line);
    if (!pose.ok()) return pose.status();
    poses.push_back(*pose);
  }
  if (poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no pose of the camera"));
  }
  return poses;
}

absl::StatusOr<StereoPair::Projection> TakeProjection(std::vector<Words>& lines,
                                                      std::size_t first) {
  StereoPair::Projection projection;
  for (int row = 0; row < 3; ++row) {
    Words& line = lines[first + row];
    if (line.size() != 4) return WrongCount(line, "4 numbers of a projection matrix");
    for (int column = 0; column < 4; ++column) projection(row, column) = line.Number(column);
    if (!line.status().ok()) return line.status();
  }
  return projection;
}

}  // namespace

Pose ClusterPose::In(QuaternionOrder order) const {
  const Eigen::Vector4d& q = quaternion;
  return {order == QuaternionOrder::kWFirst ? Eigen::Quaterniond(q[0], q[1], q[2], q[3])
                                            : Eigen::Quaterniond(q[3], q[0], q[1], q[2]),
          translation};
}

absl::StatusOr<ClusterPoses> ReadClusterPoses(const Path& folder) {
  const auto files = NumberedFiles(folder, ".txt");
  if (!files.ok()) return files.status();
  ClusterPoses poses;
  for (const auto& [frame, path] : *files) {
    auto of_frame = ReadFramePoses(path);
    if (!of_frame.ok()) return of_frame.status();
    // A line's number is its cluster's id, so a line that is gone would make others of all.
    if (!poses.empty() && of_frame->size() != poses.begin()->second.size()) {
      return absl::InvalidArgumentError(absl::StrCat(path.string(), ": ", of_frame->size(),
                                                     " poses; frame ", poses.begin()->first,
                                                     " has ", poses.begin()->second.size()));
    }
    poses[frame] = *std::move(of_frame);
  }
  if (poses.empty()) {
    return absl::NotFoundError(absl::StrCat(folder.string(), ": no poses, 0000.txt and so on"));
  }
  return poses;
}

absl::StatusOr<LandmarkClusters> ReadLandmarkClusters(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  LandmarkClusters clusters;
  for (Words& line : *lines) {
    if (line.size() != 2) return WrongCount(line, "landmark and cluster");
    const int landmark = line.Integer(0, 0);
    const ObjectId cluster = line.Integer(1, 0);
    if (!line.status().ok()) return line.status();
    if (clusters.try_emplace(landmark, cluster).second) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(line.where(), ": landmark ", landmark, " occurs twice"));
  }
  if (clusters.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no landmark has a cluster"));
  }
  return clusters;
}

absl::StatusOr<Landmarks> ReadLandmarks(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  Landmarks landmarks;
  for (Words& line : *lines) {
    if (line.size() != 3) return WrongCount(line, "landmark u v");
    const int landmark = line.Integer(0, 0);
    const Eigen::Vector2d pixel(line.Number(1), line.Number(2));
    if (!line.status().ok()) return line.status();
    if (landmarks.try_emplace(landmark, pixel).second) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(line.where(), ": landmark ", landmark, " occurs twice"));
  }
  return landmarks;
}

absl::StatusOr<StereoPair> ReadClusterCameras(const Path& folder) {
  std::error_code error;
  Path path = folder / "intrinsic.txt";
  if (const Path other = folder / "instrinsic.txt";
      !std::filesystem::exists(path, error) && std::filesystem::exists(other, error)) {
    path = other;
  }
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  if (lines->size() != 6) {
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": ", lines->size(), " lines of numbers, expected two matrices of 3"));
  }
  const auto left = TakeProjection(*lines, 0);
  if (!left.ok()) return left.status();
  const auto right = TakeProjection(*lines, 3);
  if (!right.ok()) return right.status();
  return StereoPair::Make(*left, *right, path.string());
}

}  // namespace clearway
