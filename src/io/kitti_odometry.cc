#include "clearway/io/kitti_odometry.h"

#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "io/keyed_rows.h"
#include "io/lidar_frames.h"
#include "io/numbered_scans.h"
#include "io/pose_table.h"
#include "io/rigid_matrix.h"
#include "io/velodyne_points.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr Duration kPeriod = std::chrono::milliseconds(100);

// Classes of things that can move, each with the number that its ids begin with.
struct Thing {
  int parked, moving, number;
};
constexpr Thing kThings[] = {{10, 252, 1}, {31, 253, 2}, {30, 254, 3}, {32, 255, 4},
                             {16, 256, 5}, {13, 257, 6}, {18, 258, 7}, {20, 259, 8}};
constexpr int kFirstMoving = 252, kLastMoving = 259, kUnlabeled = 0, kOutlier = 1;

Path Plain(const Path& given) {
  std::error_code error;
  Path path = std::filesystem::absolute(given, error).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

// From the velodyne to the left camera.
absl::StatusOr<Pose> ReadMount(const Path& path) {
  auto lines = ReadWordRows(path, {.last = LastLine::kMayBeOpen});
  if (!lines.ok()) return lines.status();
  const auto found = RowOfKey(*lines, {"Tr"});
  if (!found.ok()) return found.status();
  if (*found == nullptr) return absl::InvalidArgumentError(path.string() + ": no Tr");
  Row& line = **found;
  if (line.size() != 13) return line.WrongCount("a key and 12");
  Eigen::Matrix<double, 3, 4> matrix;
  for (int i = 0; i < 12; ++i) {
    matrix(i / 4, i % 4) = line.Coordinate(static_cast<std::size_t>(i) + 1);
  }
  if (!line.status().ok()) return line.status();
  return PoseOfMatrix(matrix, line.where());
}

// SemanticKITTI has the poses in the sequence, the benchmark in a folder of their own.
absl::StatusOr<Path> PosesOf(const Path& sequence) {
  const Path here = sequence / "poses.txt";
  const Path beside = sequence.parent_path().parent_path() / "poses" /
                      absl::StrCat(sequence.filename().string(), ".txt");
  std::error_code error;
  for (const Path& path : {here, beside}) {
    if (std::filesystem::exists(path, error)) return path;
  }
  return absl::NotFoundError(absl::StrCat(here.string(), ": no such file, nor ", beside.string(),
                                          "; the testing half of KITTI has no poses"));
}

absl::StatusOr<std::vector<RecordedPose>> SensorPoses(const Path& sequence, const Path& path,
                                                      LeftOut& left_out) {
  const auto T_C_S = ReadMount(sequence / "calib.txt");
  if (!T_C_S.ok()) return T_C_S.status();
  auto table = ReadKittiPoses(path, sequence / "times.txt", kPeriod, left_out);
  if (!table.ok()) return table.status();
  std::vector<RecordedPose> poses =
      InOrder(path, std::move(table->rows), left_out, table->times_path);
  const Pose T_S_C = Inverse(*T_C_S);
  for (RecordedPose& pose : poses) pose.T_W_S = T_S_C * pose.T_W_S * *T_C_S;
  return poses;
}

// All points static, without a file of labels.
absl::Status ReadLabels(const std::optional<Path>& path, ParkedObjects parked, Frame& frame) {
  const std::size_t count = frame.points_S.size();
  frame.labels.assign(count, kStaticLabel);
  if (!path) return absl::OkStatus();
  const auto bytes = ReadWholeFile(*path, 4 * std::uint64_t{20'000'000});
  if (!bytes.ok()) return bytes.status();
  if (bytes->size() != 4 * count) {
    return absl::InvalidArgumentError(absl::StrCat(path->string(), ": ", bytes->size(),
                                                   " bytes; the scan's ", count, " points need ",
                                                   4 * count));
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t label;
    std::memcpy(&label, bytes->data() + 4 * i, sizeof label);
    frame.labels[i] = SemanticKittiObject(label, parked);
  }
  return absl::OkStatus();
}

std::string Described(const std::string& name, bool labelled, ParkedObjects parked) {
  if (!labelled) return name + "; no folder labels: all points are static";
  return absl::StrCat(name, "; labels without motions; parked vehicles are ",
                      parked == ParkedObjects::kStatic ? "static" : "objects");
}

}  // namespace

ObjectId SemanticKittiObject(std::uint32_t label, ParkedObjects parked) {
  constexpr int kIdsOfClass = 100'000;
  const int label_class = static_cast<int>(label & 0xffff);
  const int instance = static_cast<int>(label >> 16);
  if (label_class == kUnlabeled || label_class == kOutlier) return kIgnoreLabel;
  const bool moves = label_class >= kFirstMoving && label_class <= kLastMoving;
  for (const Thing& thing : kThings) {
    const bool is_parked = thing.parked == label_class && parked == ParkedObjects::kObjects;
    if (thing.moving != label_class && !is_parked) continue;
    if (instance > 0) return thing.number * kIdsOfClass + instance;
  }
  return moves ? kIgnoreLabel : kStaticLabel;
}

bool IsKittiOdometry(const Path& sequence) {
  std::error_code error;
  return std::filesystem::is_directory(sequence / "velodyne", error) &&
         std::filesystem::is_regular_file(sequence / "calib.txt", error);
}

absl::StatusOr<LidarFolder> OpenKittiOdometry(const Path& given,
                                              const KittiOdometryOptions& options) {
  const Path sequence = Plain(given);
  LidarScans scans;
  const auto table = PosesOf(sequence);
  if (!table.ok()) return table.status();
  auto poses = SensorPoses(sequence, *table, *scans.left_out);
  if (!poses.ok()) return poses.status();
  std::error_code error;
  const Path label_folder = sequence / "labels";
  const bool labelled = std::filesystem::is_directory(label_folder, error);
  scans.name = absl::StrCat("KITTI odometry sequence ", sequence.string());
  scans.options = options.frames;
  scans.options.objects = LidarObjects::kNone;
  scans.poses = *std::move(poses);
  const auto files = NumberedScans::In(sequence / "velodyne", ".bin", 6);
  if (!files.ok()) return files.status();
  files->LeaveOutUnposed(scans.poses, *table, *scans.left_out);
  scans.points_of = [files = *files](int frame) { return files.FileOf(frame); };
  scans.read = [labelled, label_folder, parked = options.parked](
                   const Path& points, std::span<const RecordedBox>, Frame& frame) {
    const absl::Status status = ReadVelodynePoints(points, frame);
    if (!status.ok()) return status;
    const Path labels = label_folder / points.filename().replace_extension(".label");
    return ReadLabels(labelled ? std::optional(labels) : std::nullopt, parked, frame);
  };
  const std::string description = Described(scans.name, labelled, options.parked);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
