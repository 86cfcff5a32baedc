#include "io/cluster_slam_files.h"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "io/numbered_files.h"
#include "io/word_table.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr WordFormat kFormat{.last = LastLine::kMayBeOpen};
constexpr std::int64_t kMaxNumber = 99'999'999;  // of landmarks and clusters

// An error of the row if it has no pose.
std::optional<ClusterPose> TakePose(Row& row) {
  if (row.size() != 7) {
    row.WrongCount("x y z and a quaternion").IgnoreError();
    return std::nullopt;
  }
  // The order of the quaternion's numbers does not matter to its length.
  const Pose pose = row.PoseFrom(0);
  if (!row.status().ok()) return std::nullopt;
  return ClusterPose{pose.translation, pose.rotation.coeffs()};
}

// A frame's poses, as far as its rows are good.
struct FrameRows {
  Path path;
  std::optional<ClusterPose> camera;
  std::vector<std::optional<ClusterPose>> clusters;
  std::string why_no_camera;
  std::vector<std::string> bad_rows;  // of clusters
};

absl::StatusOr<FrameRows> ReadFrameRows(const Path& path) {
  auto lines = ReadWordRows(path, kFormat);
  if (!lines.ok()) return lines.status();
  FrameRows frame;
  frame.path = path;
  if (lines->rows.empty()) {
    frame.why_no_camera = absl::StrCat(path.string(), ": no pose of the camera");
    return frame;
  }
  for (std::size_t i = 0; i < lines->rows.size(); ++i) {
    Row& row = lines->rows[i];
    const auto pose = TakePose(row);
    const std::string why(row.status().message());
    if (i == 0) {
      frame.camera = pose;
      frame.why_no_camera = why;
    } else {
      frame.clusters.push_back(pose);
      if (!pose) frame.bad_rows.push_back(why);
    }
  }
  return frame;
}

// The number of clusters that most frames with a camera have.
std::size_t UsualCount(const std::map<int, FrameRows>& frames) {
  std::map<std::size_t, std::size_t> counts;
  for (const auto& [number, frame] : frames) {
    if (frame.camera) ++counts[frame.clusters.size()];
  }
  const auto most = std::ranges::max_element(counts, {}, [](const auto& c) { return c.second; });
  return most == counts.end() ? 0 : most->first;
}

absl::StatusOr<StereoPair::Projection> TakeProjection(WordRows& lines, std::size_t first) {
  StereoPair::Projection projection;
  for (int i = 0; i < 3; ++i) {
    Row& row = lines.rows[first + i];
    if (row.size() != 4) return row.WrongCount("4 numbers of a projection matrix");
    for (int column = 0; column < 4; ++column) projection(i, column) = row.Coordinate(column);
    if (!row.status().ok()) return row.status();
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

absl::StatusOr<ClusterPoses> ReadClusterPoses(const Path& folder, LeftOut& left_out) {
  const auto files = NumberedFiles(folder, ".txt");
  if (!files.ok()) return files.status();
  if (files->empty()) {
    return absl::NotFoundError(absl::StrCat(folder.string(), ": no poses, 0000.txt and so on"));
  }
  std::map<int, FrameRows> frames;
  for (const auto& [number, path] : *files) {
    auto frame = ReadFrameRows(path);
    if (!frame.ok()) return frame.status();
    frames.emplace(number, *std::move(frame));
  }
  const std::size_t usual = UsualCount(frames);
  ClusterPoses poses;
  for (auto& [number, frame] : frames) {
    if (!frame.camera) {
      left_out.AddFrame(frame.why_no_camera);
    } else if (frame.clusters.size() != usual) {
      left_out.AddFrame(absl::StrCat(frame.path.string(), ": ", frame.clusters.size() + 1,
                                     " poses; most frames have ", usual + 1));
    } else {
      for (std::string& why : frame.bad_rows) left_out.AddRow(std::move(why));
      poses.emplace(number, ClusterFrame{*frame.camera, std::move(frame.clusters)});
    }
  }
  if (!poses.empty()) return poses;
  return absl::InvalidArgumentError(
      absl::StrCat(frames.begin()->second.why_no_camera, "; no frame has a pose of the camera"));
}

absl::StatusOr<LandmarkClusters> ReadLandmarkClusters(const Path& path, LeftOut& left_out) {
  LandmarkClusters clusters;
  const auto visit = [&](Row& row) {
    if (row.size() != 2) return row.WrongCount("landmark and cluster");
    const auto landmark = static_cast<int>(row.Integer(0, 0, kMaxNumber));
    const auto cluster = static_cast<ObjectId>(row.Integer(1, 0, kMaxNumber));
    if (!row.status().ok()) return row.status();
    if (clusters.try_emplace(landmark, cluster).second) return absl::OkStatus();
    return row.Error(absl::StrCat("landmark ", landmark, " occurs twice"));
  };
  if (auto status = VisitWords(path, kFormat, left_out, visit); !status.ok()) return status;
  if (clusters.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no landmark has a cluster"));
  }
  return clusters;
}

absl::StatusOr<Landmarks> ReadLandmarks(const Path& path, LeftOut& left_out) {
  Landmarks landmarks;
  const auto visit = [&](Row& row) {
    if (row.size() != 3) return row.WrongCount("landmark u v");
    const auto landmark = static_cast<int>(row.Integer(0, 0, kMaxNumber));
    const Eigen::Vector2d pixel(row.Coordinate(1), row.Coordinate(2));
    if (!row.status().ok()) return row.status();
    if (landmarks.try_emplace(landmark, pixel).second) return absl::OkStatus();
    return row.Error(absl::StrCat("landmark ", landmark, " occurs twice"));
  };
  if (auto status = VisitWords(path, kFormat, left_out, visit); !status.ok()) return status;
  return landmarks;
}

absl::StatusOr<StereoPair> ReadClusterCameras(const Path& folder) {
  std::error_code error;
  Path path = folder / "intrinsic.txt";
  if (const Path other = folder / "instrinsic.txt";
      !std::filesystem::exists(path, error) && std::filesystem::exists(other, error)) {
    path = other;
  }
  auto lines = ReadWordRows(path, kFormat);
  if (!lines.ok()) return lines.status();
  if (lines->rows.size() != 6) {
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": ", lines->rows.size(), " lines of numbers, expected two matrices of 3"));
  }
  const auto left = TakeProjection(*lines, 0);
  if (!left.ok()) return left.status();
  const auto right = TakeProjection(*lines, 3);
  if (!right.ok()) return right.status();
  return StereoPair::Make(*left, *right, path.string());
}

}  // namespace clearway
