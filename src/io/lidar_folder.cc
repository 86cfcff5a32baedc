#include "clearway/io/lidar_folder.h"

#include <bit>
#include <cstring>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "io/lidar_frames.h"
#include "io/lidar_tables.h"
#include "io/numbered_scans.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "points are stored little endian");

constexpr std::size_t kRecordBytes = 14;  // float32 x, y, z, int16 label
constexpr std::uint64_t kMaxPointBytes = kRecordBytes * 20'000'000;

using Path = std::filesystem::path;

absl::Status ReadPoints(const Path& path, Frame& frame) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxPointBytes);
  if (!bytes.ok()) return bytes.status();
  if (bytes->size() % kRecordBytes != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": ", bytes->size(), " bytes are not a whole number of ",
                     kRecordBytes, "-byte points; the file seems cut off"));
  }
  const std::size_t count = bytes->size() / kRecordBytes;
  frame.points_S.resize(count);
  frame.labels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* const record = bytes->data() + i * kRecordBytes;
    std::int16_t label;
    std::memcpy(frame.points_S[i].data(), record, 12);
    std::memcpy(&label, record + 12, 2);
    if (label < kIgnoreLabel) {
      return absl::InvalidArgumentError(absl::StrCat(path.string(), ", point ", i, " at byte ",
                                                     i * kRecordBytes + 12, ": label ", label,
                                                     "; the lowest is ", kIgnoreLabel));
    }
    frame.labels[i] = label;
  }
  return absl::OkStatus();
}

constexpr char kOxtsSuffix[] = "_oxts";

constexpr char kNoKnownLayout[] =
    ": the files of no known layout are there:\n"
    "  LiDAR folder           poses.csv, poses_icp.csv or poses_oxts.csv\n"
    "  KITTI tracking         name the folder of the scans, training/velodyne/NNNN\n"
    "  KITTI odometry         velodyne and calib.txt (SemanticKITTI: labels, too)\n"
    "  PCD or PLY files       *.pcd or *.ply, and poses.txt\n"
    "  TUM RGB-D              depth.txt\n"
    "  ClusterSLAM            landmark_mapping.txt and pose\n"
    "  CARLA                  carla_sensor.csv\n"
    "  DynoSAM                *_camera_pose_log.csv\n"
    "docs/formats.md describes them";

// The part of the tables' names that tells the pairs apart.
absl::StatusOr<std::string> TableSuffix(const Path& folder, LidarPoses poses) {
  constexpr std::pair<LidarPoses, const char*> kPairs[] = {
      {LidarPoses::kPlain, ""}, {LidarPoses::kIcp, "_icp"}, {LidarPoses::kOxts, kOxtsSuffix}};
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    return absl::NotFoundError(absl::StrCat(folder.string(), ": no such folder"));
  }
  for (const auto& [kind, suffix] : kPairs) {
    if (poses == kind) return suffix;
    if (poses == LidarPoses::kAny &&
        std::filesystem::exists(folder / absl::StrCat("poses", suffix, ".csv"), error)) {
      return suffix;
    }
  }
  return absl::NotFoundError(absl::StrCat(folder.string(), kNoKnownLayout));
}

}  // namespace

absl::StatusOr<LidarFolder> OpenLidarFolder(const Path& folder, const LidarFolderOptions& options) {
  const absl::StatusOr<std::string> suffix = TableSuffix(folder, options.poses);
  if (!suffix.ok()) return suffix.status();
  const auto left_out = std::make_shared<LeftOut>();
  const Path table = folder / absl::StrCat("poses", *suffix, ".csv");
  const auto poses = ReadLidarPoses(table, *left_out);
  if (!poses.ok()) return poses.status();
  const auto boxes =
      ReadLidarBoxes(folder / absl::StrCat("objects", *suffix, ".csv"), *poses, *left_out);
  if (!boxes.ok()) return boxes.status();
  const auto scans = NumberedScans::In(folder / "points", ".bin", 4);
  if (!scans.ok()) return scans.status();
  scans->LeaveOutUnposed(*poses, table, *left_out);

  return FramesOf({.name = absl::StrCat("LiDAR folder ", folder.string()),
                   .options = options,
                   .poses = *poses,
                   .boxes = *boxes,
                   .of_gps = *suffix == kOxtsSuffix,
                   .left_out = left_out,
                   .points_of = [files = *scans](int frame) { return files.FileOf(frame); },
                   .read = [](const Path& points, std::span<const RecordedBox>,
                              Frame& frame) { return ReadPoints(points, frame); }});
}

}  // namespace clearway
