#include "clearway/io/cluster_slam.h"

#include <map>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "io/cluster_slam_files.h"
#include "io/cluster_slam_fit.h"
#include "io/lidar_frames.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr char kMapping[] = "landmark_mapping.txt";
constexpr double kMostError_px = 10;

// What frames are made of besides their landmarks. Shared by the copies of a FrameSource.
struct Sequence {
  Path folder;
  StereoPair cameras;
  LandmarkClusters clusters;
  ClusterPoses poses;
  std::optional<double> max_depth_m;
  bool allow_missing = false;  // files of landmarks

  Path FileOf(const char* side, int frame) const {
    return folder / "landmarks" / side / absl::StrFormat("%04d.txt", frame);
  }
};

ClusterPoints PointsOf(const Sequence& sequence, const Landmarks& left, const Landmarks& right) {
  ClusterPoints points;
  for (const auto& [landmark, pixel] : left) {
    const auto other = right.find(landmark);
    if (other == right.end()) continue;
    const auto p_S = sequence.cameras.Triangulate(pixel, other->second);
    if (!p_S || (sequence.max_depth_m && p_S->z() > *sequence.max_depth_m)) continue;
    const auto cluster = sequence.clusters.find(landmark);
    const ObjectId label = cluster == sequence.clusters.end() ? kIgnoreLabel : cluster->second;
    points.push_back({landmark, label, *p_S, pixel});
  }
  return points;
}

absl::StatusOr<ClusterPoints> ReadPoints(const Sequence& sequence, int frame) {
  const auto left = ReadLandmarks(sequence.FileOf("left", frame));
  const auto right = ReadLandmarks(sequence.FileOf("right", frame));
  for (const absl::Status& status : {left.status(), right.status()}) {
    if (absl::IsNotFound(status) && sequence.allow_missing) return ClusterPoints();
    if (!status.ok()) return status;
  }
  return PointsOf(sequence, *left, *right);
}

absl::StatusOr<Sequence> ReadSequence(const Path& folder, const ClusterSlamOptions& options) {
  auto cameras = ReadClusterCameras(folder);
  if (!cameras.ok()) return cameras.status();
  auto clusters = ReadLandmarkClusters(folder / kMapping);
  if (!clusters.ok()) return clusters.status();
  auto poses = ReadClusterPoses(folder / "pose");
  if (!poses.ok()) return poses.status();
  return Sequence{folder,
                  *std::move(cameras),
                  *std::move(clusters),
                  *std::move(poses),
                  options.max_depth_m,
                  options.allow_missing_points};
}

absl::Status CheckFit(const ClusterFit& fit, const Path& folder, LidarObjects objects) {
  if (fit.static_px && !(*fit.static_px <= kMostError_px)) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder.string(), ": static landmarks are seen ", *fit.static_px,
        " pixels (median) from where the camera's poses put them, whatever the order of their "
        "quaternions; the limit is ",
        kMostError_px));
  }
  if (objects != LidarObjects::kNone && fit.moving_px && !(*fit.moving_px <= kMostError_px)) {
    return absl::InvalidArgumentError(
        absl::StrCat(folder.string(), ": landmarks of moving clusters are seen ", *fit.moving_px,
                     " pixels (median) from where the clusters' poses put them; the limit is ",
                     kMostError_px, " (--objects none goes on without these poses)"));
  }
  return absl::OkStatus();
}

std::string Described(const std::string& name, const ClusterFit& fit) {
  std::string text =
      absl::StrCat(name, "; quaternions are ",
                   fit.order == QuaternionOrder::kWFirst ? "w, x, y, z" : "x, y, z, w");
  if (fit.static_px) {
    absl::StrAppendFormat(&text, "; landmarks are seen %.1f pixels from where poses put them",
                          *fit.static_px);
  }
  if (fit.moving_px) absl::StrAppendFormat(&text, ", those that move %.1f", *fit.moving_px);
  return text;
}

void SetPoses(const ClusterPoses& poses, QuaternionOrder order, Duration period,
              LidarScans& scans) {
  constexpr int kNotSaid = -1;
  for (const auto& [frame, of_frame] : poses) {
    scans.poses.push_back(
        {frame, TimeFromNanoseconds(frame * period.count()), of_frame[0].In(order)});
    for (std::size_t cluster = 1; cluster < of_frame.size(); ++cluster) {
      scans.boxes.push_back({frame, static_cast<ObjectId>(cluster), "cluster",
                             Eigen::Vector3d::Zero(), of_frame[cluster].In(order), kNotSaid});
    }
  }
}

absl::Status Fill(const Sequence& sequence, Frame& frame) {
  const auto points = ReadPoints(sequence, static_cast<int>(frame.sequence));
  if (!points.ok()) return points.status();
  for (const ClusterPoint& point : *points) {
    frame.points_S.push_back(point.p_S.cast<float>());
    frame.labels.push_back(point.label);
  }
  return absl::OkStatus();
}

}  // namespace

bool IsClusterSlam(const Path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / kMapping, error) &&
         std::filesystem::is_directory(folder / "pose", error);
}

absl::StatusOr<LidarFolder> OpenClusterSlam(const Path& given, const ClusterSlamOptions& options) {
  if (auto status = CheckFramePeriod(options.frame_period); !status.ok()) return status;
  std::error_code error;
  const Path folder = std::filesystem::absolute(given, error).lexically_normal();
  auto read = ReadSequence(folder, options);
  if (!read.ok()) return read.status();
  const auto sequence = std::make_shared<const Sequence>(*std::move(read));
  const auto fit = FitOf(sequence->poses, sequence->cameras,
                         [&](int frame) { return ReadPoints(*sequence, frame); });
  if (!fit.ok()) return fit.status();
  if (auto status = CheckFit(*fit, folder, options.objects); !status.ok()) return status;
  LidarScans scans;
  scans.name = absl::StrCat("ClusterSLAM sequence ", folder.string());
  scans.options = {.objects = options.objects,
                   .motions_over = options.motions_over,
                   .first_frame = options.first_frame,
                   .last_frame = options.last_frame,
                   .allow_missing_points = options.allow_missing_points,
                   .sensor_id = options.sensor_id};
  SetPoses(sequence->poses, fit->order, options.frame_period, scans);
  scans.points_of = [sequence](int frame) { return sequence->FileOf("left", frame); };
  scans.read = [sequence](const Path&, std::span<const RecordedBox>, Frame& frame) {
    return Fill(*sequence, frame);
  };
  const std::string description = Described(scans.name, *fit);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
