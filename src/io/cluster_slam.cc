#include "clearway/io/cluster_slam.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/base/number_text.h"
#include "io/cluster_slam_files.h"
#include "io/cluster_slam_fit.h"
#include "io/lidar_frames.h"
#include "io/numbered_files.h"

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

// A landmark that both cameras see; pixels.
struct SeenTwice {
  int landmark = 0;
  Eigen::Vector2d left, right;
};

absl::StatusOr<std::vector<SeenTwice>> ReadSeenTwice(const Sequence& sequence, int frame,
                                                     LeftOut& left_out) {
  const auto left = ReadLandmarks(sequence.FileOf("left", frame), left_out);
  const auto right = ReadLandmarks(sequence.FileOf("right", frame), left_out);
  std::vector<SeenTwice> seen;
  for (const absl::Status& status : {left.status(), right.status()}) {
    if (absl::IsNotFound(status) && sequence.allow_missing) return seen;
    if (!status.ok()) return status;
  }
  for (const auto& [landmark, pixel] : *left) {
    const auto other = right->find(landmark);
    if (other != right->end()) seen.push_back({landmark, pixel, other->second});
  }
  return seen;
}

absl::StatusOr<ClusterPoints> ReadPoints(const Sequence& sequence, int frame, LeftOut& left_out) {
  const auto seen = ReadSeenTwice(sequence, frame, left_out);
  if (!seen.ok()) return seen.status();
  ClusterPoints points;
  for (const SeenTwice& landmark : *seen) {
    const auto p_S = sequence.cameras.Triangulate(landmark.left, landmark.right);
    if (!p_S || (sequence.max_depth_m && p_S->z() > *sequence.max_depth_m)) continue;
    const auto cluster = sequence.clusters.find(landmark.landmark);
    const ObjectId label = cluster == sequence.clusters.end() ? kIgnoreLabel : cluster->second;
    points.push_back({landmark.landmark, label, *p_S, landmark.left});
  }
  return points;
}

// Of cameras that are swapped no rays meet before them. Looks at frames that are spread over the
// sequence.
absl::Status CheckCameras(const Sequence& sequence) {
  constexpr std::size_t kMostFrames = 20, kFewest = 8;
  const std::size_t frames = std::min(kMostFrames, sequence.poses.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i * sequence.poses.size() / frames);
    LeftOut ignored;  // counted when frames are read
    const auto seen =
        ReadSeenTwice(sequence, std::next(sequence.poses.begin(), at)->first, ignored);
    if (!seen.ok()) return seen.status();
    for (const SeenTwice& landmark : *seen) {
      if (sequence.cameras.Triangulate(landmark.left, landmark.right)) return absl::OkStatus();
    }
    count += seen->size();
  }
  if (count < kFewest) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      sequence.folder.string(), ": of the ", count, " landmarks that both cameras see in ", frames,
      " frames none lies before them, with a disparity of a pixel or more: are left and right "
      "swapped, in landmarks or in intrinsic.txt?"));
}

absl::StatusOr<Sequence> ReadSequence(const Path& folder, const ClusterSlamOptions& options,
                                      LeftOut& left_out) {
  auto cameras = ReadClusterCameras(folder);
  if (!cameras.ok()) return cameras.status();
  auto clusters = ReadLandmarkClusters(folder / kMapping, left_out);
  if (!clusters.ok()) return clusters.status();
  auto poses = ReadClusterPoses(folder / "pose", left_out);
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
        folder.string(), ": static landmarks are seen ", NumberText(*fit.static_px),
        " pixels (median) from where the camera's poses put them, whatever the order of their "
        "quaternions; the limit is ",
        kMostError_px));
  }
  if (objects != LidarObjects::kNone && fit.moving_px && !(*fit.moving_px <= kMostError_px)) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder.string(), ": landmarks of moving clusters are seen ", NumberText(*fit.moving_px),
        " pixels (median) from where the clusters' poses put them; the limit is ", kMostError_px,
        " (--objects none goes on without these poses)"));
  }
  return absl::OkStatus();
}

// How many clusters have landmarks, but no poses.
std::size_t WithoutPoses(const Sequence& sequence) {
  const std::size_t posed = 1 + sequence.poses.begin()->second.clusters.size();
  std::set<ObjectId> clusters;
  for (const auto& [landmark, cluster] : sequence.clusters) {
    if (static_cast<std::size_t>(cluster) >= posed) clusters.insert(cluster);
  }
  return clusters.size();
}

// Leaves out the frames that have landmarks, but no poses, and tells how many. Those with a file of
// poses that is bad are named already.
absl::StatusOr<std::size_t> LeaveOutUnposed(const Sequence& sequence, LeftOut& left_out) {
  const auto landmarks = NumberedFiles(sequence.folder / "landmarks/left", ".txt");
  if (!landmarks.ok()) return landmarks.status();
  const auto poses = NumberedFiles(sequence.folder / "pose", ".txt");
  if (!poses.ok()) return poses.status();
  std::size_t count = 0;
  for (const auto& [frame, path] : *landmarks) {
    if (sequence.poses.contains(frame)) continue;
    ++count;
    if (!poses->contains(frame)) left_out.AddFrame(path.string() + ": no usable pose in pose");
  }
  return count;
}

std::string Described(const std::string& name, const Sequence& sequence, std::size_t unposed,
                      const ClusterFit& fit) {
  std::string text =
      absl::StrCat(name, "; quaternions are ", fit.static_px ? "" : "taken for ",
                   fit.order == QuaternionOrder::kWFirst ? "w, x, y, z" : "x, y, z, w",
                   fit.static_px ? "" : " (too few static landmarks to tell)");
  if (fit.static_px) {
    absl::StrAppendFormat(&text, "; landmarks are seen %.1f pixels from where poses put them",
                          *fit.static_px);
  }
  if (fit.moving_px) absl::StrAppendFormat(&text, ", those that move %.1f", *fit.moving_px);
  const auto add = [&text](const char* what, std::size_t count) {
    if (count > 0) absl::StrAppend(&text, "; ", what, ": ", count);
  };
  add("frames of landmarks without poses, left out", unposed);
  add("clusters of landmark_mapping.txt without poses", WithoutPoses(sequence));
  return text;
}

void SetPoses(const ClusterPoses& poses, QuaternionOrder order, Duration period,
              LidarScans& scans) {
  constexpr int kNotSaid = -1;
  for (const auto& [frame, of_frame] : poses) {
    scans.poses.push_back(
        {frame, TimeFromNanoseconds(frame * period.count()), of_frame.camera.In(order)});
    for (std::size_t i = 0; i < of_frame.clusters.size(); ++i) {
      if (!of_frame.clusters[i]) continue;
      scans.boxes.push_back({frame, static_cast<ObjectId>(i + 1), "cluster",
                             Eigen::Vector3d::Zero(), of_frame.clusters[i]->In(order), kNotSaid});
    }
  }
}

absl::Status Fill(const Sequence& sequence, LeftOut& left_out, Frame& frame) {
  const auto points = ReadPoints(sequence, static_cast<int>(frame.sequence), left_out);
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
  LidarScans scans;
  auto read = ReadSequence(folder, options, *scans.left_out);
  if (!read.ok()) return read.status();
  const auto sequence = std::make_shared<const Sequence>(*std::move(read));
  if (auto status = CheckCameras(*sequence); !status.ok()) return status;
  const auto fit = FitOf(sequence->poses, sequence->cameras, [&](int frame) {
    LeftOut ignored;  // counted when frames are read
    return ReadPoints(*sequence, frame, ignored);
  });
  if (!fit.ok()) return fit.status();
  if (auto status = CheckFit(*fit, folder, options.objects); !status.ok()) return status;
  scans.name = absl::StrCat("ClusterSLAM sequence ", folder.string());
  scans.options = {.objects = options.objects,
                   .motions_over = options.motions_over,
                   .first_frame = options.first_frame,
                   .last_frame = options.last_frame,
                   .allow_missing_points = options.allow_missing_points,
                   .sensor_id = options.sensor_id};
  SetPoses(sequence->poses, fit->order, options.frame_period, scans);
  scans.points_of = [sequence](int frame) { return sequence->FileOf("left", frame); };
  scans.read = [sequence, left_out = scans.left_out, counted = std::make_shared<std::set<int>>()](
                   const Path&, std::span<const RecordedBox>, Frame& frame) {
    LeftOut of_frame;
    const absl::Status status = Fill(*sequence, of_frame, frame);
    if (counted->insert(static_cast<int>(frame.sequence)).second) left_out->Add(of_frame);
    return status;
  };
  const auto unposed = LeaveOutUnposed(*sequence, *scans.left_out);
  if (!unposed.ok()) return unposed.status();
  const std::string description = Described(scans.name, *sequence, *unposed, *fit);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
