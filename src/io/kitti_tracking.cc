#include "clearway/io/kitti_tracking.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "io/kitti_tables.h"
#include "io/lidar_frames.h"
#include "io/lidar_tables.h"
#include "io/numbered_scans.h"
#include "io/velodyne_points.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::int64_t kNanosecondsPerFrame = 100'000'000;  // 10 Hz
// Images of the drives differ in size by a few pixels; the smallest one is in all of them.
constexpr double kImageWidth = 1224, kImageHeight = 370;

// However it is written: relative, with a slash at its end.
Path Plain(const Path& scans) {
  std::error_code error;
  Path path = std::filesystem::absolute(scans, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool Holds(const ImageRegion& region, const Eigen::Vector2d& pixel) {
  return pixel.x() >= region.left && pixel.x() <= region.right && pixel.y() >= region.top &&
         pixel.y() <= region.bottom;
}

// Tells of points whose they are.
class Labeller {
 public:
  Labeller(const KittiCalibration& calibration, std::multimap<int, ImageRegion> unlabelled)
      : calibration_(calibration), unlabelled_(std::move(unlabelled)) {}

  void Label(int frame_number, std::span<const RecordedBox> boxes, Frame& frame) const {
    const Pose T_S_W = Inverse(frame.T_W_S);
    std::vector<Pose> T_B_S;
    for (const RecordedBox& box : boxes) T_B_S.push_back(Inverse(T_S_W * box.T_W_B));
    const auto [first, last] = unlabelled_.equal_range(frame_number);
    frame.labels.clear();
    for (const Eigen::Vector3f& point : frame.points_S) {
      const Eigen::Vector3d p_S = point.cast<double>();
      ObjectId label = InView(p_S, first, last) ? kStaticLabel : kIgnoreLabel;
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        const Eigen::Array3d p_B = (T_B_S[b] * p_S).array().abs();
        if ((p_B <= boxes[b].size_m.array() / 2).all()) label = boxes[b].id;
      }
      frame.labels.push_back(label);
    }
  }

 private:
  using Region = std::multimap<int, ImageRegion>::const_iterator;

  // Where what moves would be labelled.
  bool InView(const Eigen::Vector3d& p_S, Region first, Region last) const {
    const Eigen::Vector3d p = calibration_.image_from_C * (calibration_.T_C_S * p_S).homogeneous();
    if (p.z() <= 0) return false;
    const Eigen::Vector2d pixel = p.head<2>() / p.z();
    return Holds({0, 0, kImageWidth, kImageHeight}, pixel) &&
           std::none_of(first, last,
                        [&](const auto& region) { return Holds(region.second, pixel); });
  }

  KittiCalibration calibration_;
  std::multimap<int, ImageRegion> unlabelled_;
};

std::vector<RecordedPose> SensorPoses(const std::vector<std::optional<Pose>>& T_W_I,
                                      const Pose& T_S_I) {
  std::vector<RecordedPose> poses;
  for (std::size_t k = 0; k < T_W_I.size(); ++k) {
    if (!T_W_I[k]) continue;
    poses.push_back({static_cast<int>(k),
                     TimeFromNanoseconds(static_cast<std::int64_t>(k) * kNanosecondsPerFrame),
                     *T_W_I[k] * Inverse(T_S_I)});
  }
  return poses;
}

// By ascending (frame, id). Boxes of frames without a pose are left out; if all are, the tables do
// not belong together.
absl::StatusOr<std::vector<RecordedBox>> BoxesInWorld(const std::vector<KittiBox>& boxes,
                                                      const std::vector<RecordedPose>& poses,
                                                      const Pose& T_C_S, const Path& path,
                                                      LeftOut& left_out) {
  std::vector<RecordedBox> result;
  std::string first_left_out;
  for (const KittiBox& box : boxes) {
    const RecordedPose* const pose = PoseOf(poses, box.frame);
    if (pose == nullptr) {
      std::string why = absl::StrCat(path.string(), ", line ", box.line, ": frame ", box.frame,
                                     " has no pose in oxts");
      if (first_left_out.empty()) first_left_out = why;
      left_out.AddRow(std::move(why));
      continue;
    }
    const Pose T_W_C = pose->T_W_S * Inverse(T_C_S);
    constexpr int kNotSaid = -1;
    result.push_back({box.frame, box.track + 1, box.type, box.size_m, T_W_C * box.T_C_B, kNotSaid});
  }
  if (result.empty() && !boxes.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(first_left_out, "; nor has any other box"));
  }
  std::ranges::sort(result, {},
                    [](const RecordedBox& box) { return std::pair(box.frame, box.id); });
  return result;
}

}  // namespace

bool IsKittiTracking(const Path& scans) {
  const Path folder = Plain(scans), root = folder.parent_path().parent_path();
  std::error_code error;
  return folder.parent_path().filename() == "velodyne" &&
         std::filesystem::exists(root / "calib", error);
}

absl::StatusOr<LidarFolder> OpenKittiTracking(const Path& scans,
                                              const LidarFolderOptions& options) {
  const Path folder = Plain(scans), root = folder.parent_path().parent_path();
  const std::string table = folder.filename().string() + ".txt";
  if (options.poses != LidarPoses::kAny && options.poses != LidarPoses::kOxts) {
    return absl::InvalidArgumentError(
        absl::StrCat(folder.string(), ": KITTI's tracking sequences have oxts poses alone"));
  }
  const auto calibration = ReadKittiCalibration(root / "calib" / table);
  if (!calibration.ok()) return calibration.status();
  LidarScans result;
  const auto T_W_I = ReadKittiOxts(root / "oxts" / table, *result.left_out);
  if (!T_W_I.ok()) return T_W_I.status();
  const Path labels_path = root / "label_02" / table;
  auto labels = ReadKittiLabels(labels_path, *result.left_out);
  if (absl::IsNotFound(labels.status())) {
    return absl::NotFoundError(absl::StrCat(labels.status().message(),
                                            "; without labels (KITTI's testing half) nothing tells "
                                            "what moves"));
  }
  if (!labels.ok()) return labels.status();
  result.name = absl::StrCat("KITTI tracking sequence ", folder.string());
  result.options = options;
  result.poses = SensorPoses(*T_W_I, calibration->T_S_I);
  auto boxes =
      BoxesInWorld(labels->boxes, result.poses, calibration->T_C_S, labels_path, *result.left_out);
  if (!boxes.ok()) return boxes.status();
  result.boxes = *std::move(boxes);
  result.of_gps = true;
  const auto files = NumberedScans::In(folder, ".bin", 6);
  if (!files.ok()) return files.status();
  files->LeaveOutUnposed(result.poses, root / "oxts" / table, *result.left_out);
  result.points_of = [files = *files](int frame) { return files.FileOf(frame); };
  const auto labeller =
      std::make_shared<const Labeller>(*calibration, std::move(labels->unlabelled));
  result.read = [labeller](const Path& points, std::span<const RecordedBox> in, Frame& frame) {
    const absl::Status status = ReadVelodynePoints(points, frame);
    if (status.ok()) labeller->Label(static_cast<int>(frame.sequence), in, frame);
    return status;
  };
  return FramesOf(std::move(result));
}

}  // namespace clearway
