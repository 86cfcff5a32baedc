#include "io/lidar_tables.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "absl/strings/str_cat.h"
#include "clearway/io/world_origin.h"
#include "io/csv.h"
#include "io/lidar_frames.h"
#include "io/rigid_matrix.h"

namespace clearway {
namespace {

constexpr std::int64_t kNanosecondsPerFrame = 100'000'000;  // KITTI's rate, 10 Hz
constexpr std::int64_t kMaxFrame = 99'999'999;
constexpr double kFarthest_m = kMaxFileCoordinate_m, kLongest_m = 1e6;

using PoseColumns = std::array<std::size_t, 12>;

absl::StatusOr<PoseColumns> FindPoseColumns(const CsvTable& table) {
  PoseColumns columns;
  for (int i = 0; i < 12; ++i) {
    const absl::StatusOr<std::size_t> column =
        table.Column(absl::StrCat("T", i / 4, i % 4));  // T00 ... T23
    if (!column.ok()) return column.status();
    columns[i] = *column;
  }
  return columns;
}

absl::StatusOr<std::vector<std::size_t>> FindColumns(const CsvTable& table,
                                                     std::initializer_list<const char*> names) {
  std::vector<std::size_t> columns;
  for (const char* name : names) {
    const absl::StatusOr<std::size_t> column = table.Column(name);
    if (!column.ok()) return column.status();
    columns.push_back(*column);
  }
  return columns;
}

// The 3x4 matrix of a row. INVALID_ARGUMENT if its left part is no rotation.
absl::StatusOr<Pose> ReadPose(const CsvTable& table, std::size_t row, const PoseColumns& columns) {
  CsvRow reader(table, row);
  Eigen::Matrix<double, 3, 4> matrix;
  for (int i = 0; i < 12; ++i) matrix(i / 4, i % 4) = reader.NumberWithin(columns[i], kFarthest_m);
  if (!reader.status().ok()) return reader.status();
  return PoseOfMatrix(matrix, absl::StrCat(table.Where(row), ", columns T00 to T22"));
}

// Where the columns of a table of boxes are.
struct BoxColumns {
  std::vector<std::size_t> fields;  // frame, track, type, l, w, h, n_points
  PoseColumns pose;
};

absl::StatusOr<BoxColumns> FindBoxColumns(const CsvTable& table) {
  const auto fields = FindColumns(table, {"frame", "track", "type", "l", "w", "h", "n_points"});
  if (!fields.ok()) return fields.status();
  const auto pose = FindPoseColumns(table);
  if (!pose.ok()) return pose.status();
  return BoxColumns{*fields, *pose};
}

absl::StatusOr<RecordedBox> ReadBox(const CsvTable& table, std::size_t row,
                                    const BoxColumns& columns) {
  constexpr std::int64_t kMaxId = std::numeric_limits<ObjectId>::max();
  CsvRow reader(table, row);
  RecordedBox box;
  box.frame = static_cast<int>(reader.Integer(columns.fields[0], 0, kMaxFrame));
  box.id = static_cast<ObjectId>(reader.Integer(columns.fields[1], 1, kMaxId));
  box.type = reader.Text(columns.fields[2]);
  for (int i = 0; i < 3; ++i) {
    box.size_m[i] = reader.NumberWithin(columns.fields[3 + i], kLongest_m);
  }
  box.n_points = static_cast<int>(reader.Integer(columns.fields[6], 0, kMaxId));
  if (!reader.status().ok()) return reader.status();
  if ((box.size_m.array() <= 0).any()) {
    return absl::InvalidArgumentError(
        absl::StrCat(table.Where(row), ", columns l, w, h: a box of ", box.size_m.x(), " x ",
                     box.size_m.y(), " x ", box.size_m.z(), " m; each length must be above 0"));
  }
  const absl::StatusOr<Pose> T_W_B = ReadPose(table, row, columns.pose);
  if (!T_W_B.ok()) return T_W_B.status();
  box.T_W_B = *T_W_B;
  return box;
}

auto KeyOf(const RecordedBox& box) { return std::tie(box.frame, box.id); }

}  // namespace

absl::StatusOr<std::vector<RecordedPose>> ReadLidarPoses(const std::filesystem::path& path) {
  const absl::StatusOr<CsvTable> table = CsvTable::Read(path);
  if (!table.ok()) return table.status();
  const auto frame_column = table->Column("frame");
  if (!frame_column.ok()) return frame_column.status();
  const auto pose_columns = FindPoseColumns(*table);
  if (!pose_columns.ok()) return pose_columns.status();
  const bool stamped = table->HasColumn("timestamp_ns");
  const std::size_t stamp_column = stamped ? *table->Column("timestamp_ns") : 0;

  std::vector<RecordedPose> poses;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    CsvRow reader(*table, row);
    RecordedPose pose;
    pose.frame = static_cast<int>(reader.Integer(*frame_column, 0, kMaxFrame));
    pose.stamp = TimeFromNanoseconds(
        stamped ? reader.Integer(stamp_column, 0, std::numeric_limits<std::int64_t>::max())
                : pose.frame * kNanosecondsPerFrame);
    if (!reader.status().ok()) return reader.status();
    const absl::StatusOr<Pose> T_W_S = ReadPose(*table, row, *pose_columns);
    if (!T_W_S.ok()) return T_W_S.status();
    pose.T_W_S = *T_W_S;
    if (!poses.empty() && (pose.frame <= poses.back().frame || pose.stamp <= poses.back().stamp)) {
      return absl::InvalidArgumentError(
          absl::StrCat(table->Where(row), ": frame ", pose.frame, " at ", ToNanoseconds(pose.stamp),
                       " ns does not come after frame ", poses.back().frame, " at ",
                       ToNanoseconds(poses.back().stamp), " ns"));
    }
    poses.push_back(pose);
  }
  if (poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no pose under the header"));
  }
  return poses;
}

absl::Status SortBoxes(const std::filesystem::path& path, std::vector<RecordedBox>& boxes) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const auto& a, const auto& b) { return KeyOf(a) < KeyOf(b); });
  const auto twice =
      std::adjacent_find(boxes.begin(), boxes.end(),
                         [](const auto& a, const auto& b) { return KeyOf(a) == KeyOf(b); });
  if (twice != boxes.end()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": frame ", twice->frame,
                                                   " has two boxes of track ", twice->id));
  }
  return absl::OkStatus();
}

absl::StatusOr<std::vector<RecordedBox>> ReadLidarBoxes(const std::filesystem::path& path,
                                                        const std::vector<RecordedPose>& poses) {
  const absl::StatusOr<CsvTable> table = CsvTable::Read(path);
  if (!table.ok()) return table.status();
  const absl::StatusOr<BoxColumns> columns = FindBoxColumns(*table);
  if (!columns.ok()) return columns.status();
  std::vector<RecordedBox> boxes;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    absl::StatusOr<RecordedBox> box = ReadBox(*table, row, *columns);
    if (!box.ok()) return box.status();
    if (PoseOf(poses, box->frame) == nullptr) {
      return absl::InvalidArgumentError(absl::StrCat(table->Where(row, columns->fields[0]),
                                                     ": frame ", box->frame,
                                                     " has no pose of the sensor"));
    }
    boxes.push_back(*std::move(box));
  }
  if (auto status = SortBoxes(path, boxes); !status.ok()) return status;
  return boxes;
}

}  // namespace clearway
