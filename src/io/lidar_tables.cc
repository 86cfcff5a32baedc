#include "io/lidar_tables.h"

#include <algorithm>
#include <array>
#include <limits>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "io/header_table.h"
#include "io/lidar_frames.h"
#include "io/rigid_matrix.h"

namespace clearway {
namespace {

constexpr std::int64_t kNanosecondsPerFrame = 100'000'000;  // KITTI's rate, 10 Hz
constexpr std::int64_t kMaxFrame = 99'999'999;
constexpr double kLongest_m = 1e6;
constexpr std::int64_t kMaxId = std::numeric_limits<ObjectId>::max();

// Those named, then T00 to T23.
std::vector<WantedColumn> WithMatrix(std::vector<WantedColumn> columns) {
  for (int i = 0; i < 12; ++i) columns.push_back({absl::StrCat("T", i / 4, i % 4)});
  return columns;
}

// The 3x4 matrix whose numbers begin at a column.
absl::StatusOr<Pose> TakePose(Row& row, std::size_t first) {
  Eigen::Matrix<double, 3, 4> matrix;
  for (int i = 0; i < 12; ++i) matrix(i / 4, i % 4) = row.Coordinate(first + i);
  if (!row.status().ok()) return row.status();
  return PoseOfMatrix(matrix, absl::StrCat(row.where(), ", columns T00 to T22"));
}

absl::StatusOr<RecordedBox> TakeBox(Row& row) {
  RecordedBox box;
  box.frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
  box.id = static_cast<ObjectId>(row.Integer(1, 1, kMaxId));
  box.type = row.PlainText(2);
  for (int i = 0; i < 3; ++i) box.size_m[i] = row.NumberWithin(3 + i, kLongest_m);
  box.n_points = static_cast<int>(row.Integer(6, 0, kMaxId));
  if (!row.status().ok()) return row.status();
  if ((box.size_m.array() <= 0).any()) {
    return row.Error(absl::StrCat("columns l, w, h: a box of ", NumberText(box.size_m.x()), " x ",
                                  NumberText(box.size_m.y()), " x ", NumberText(box.size_m.z()),
                                  " m; each length must be above 0"));
  }
  const absl::StatusOr<Pose> T_W_B = TakePose(row, 7);
  if (!T_W_B.ok()) return T_W_B.status();
  box.T_W_B = *T_W_B;
  return box;
}

// Which of the rows, by ascending frames, are a longest sequence of ascending stamps.
std::vector<bool> Ascending(const std::vector<TablePose>& rows) {
  std::vector<std::size_t> ends;  // by length less one: where the sequence with the lowest end ends
  std::vector<std::size_t> before(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto place = std::ranges::lower_bound(
        ends, rows[i].pose.stamp, {}, [&](std::size_t end) { return rows[end].pose.stamp; });
    before[i] = place == ends.begin() ? i : *std::prev(place);
    if (place == ends.end()) {
      ends.push_back(i);
    } else {
      *place = i;
    }
  }
  std::vector<bool> kept(rows.size(), false);
  for (std::size_t i = ends.empty() ? 0 : ends.back(); !ends.empty(); i = before[i]) {
    kept[i] = true;
    if (before[i] == i) break;
  }
  return kept;
}

}  // namespace

std::vector<RecordedPose> InOrder(const std::filesystem::path& path, std::vector<TablePose> rows,
                                  LeftOut& left_out, const std::filesystem::path& times_path) {
  std::ranges::stable_sort(rows, {}, [](const TablePose& row) { return row.pose.frame; });
  const auto leave_out = [&](const std::filesystem::path& table, int line, const std::string& why) {
    left_out.AddRow(absl::StrCat(table.string(), ", line ", line, ": ", why));
  };
  std::vector<TablePose> single;
  for (TablePose& row : rows) {
    if (single.empty() || single.back().pose.frame != row.pose.frame) {
      single.push_back(std::move(row));
    } else {
      leave_out(path, row.line,
                absl::StrCat("a second row of frame ", row.pose.frame, "; the first: line ",
                             single.back().line));
    }
  }
  const std::vector<bool> kept = Ascending(single);
  std::vector<RecordedPose> poses;
  const bool timed = !times_path.empty();
  for (std::size_t i = 0; i < single.size(); ++i) {
    const TablePose& row = single[i];
    if (kept[i]) {
      poses.push_back(row.pose);
    } else {
      leave_out(timed ? times_path : path, timed ? row.stamp_line : row.line,
                absl::StrCat("frame ", row.pose.frame, " at ", ToNanoseconds(row.pose.stamp),
                             " ns: stamps must ascend with the frames"));
    }
  }
  return poses;
}

absl::Status BoxRows::Add(const Row& row, RecordedBox box) {
  const auto [first, is_new] = boxes_.try_emplace({box.frame, box.id}, row.line(), std::move(box));
  if (is_new) return absl::OkStatus();
  const auto [frame, id] = first->first;
  return row.Error(absl::StrCat("a second box of track ", id, " in frame ", frame,
                                "; the first: line ", first->second.first));
}

std::vector<RecordedBox> BoxRows::Take() {
  std::vector<RecordedBox> boxes;
  boxes.reserve(boxes_.size());
  for (auto& [key, box] : boxes_) boxes.push_back(std::move(box.second));
  return boxes;
}

absl::StatusOr<std::vector<RecordedPose>> ReadLidarPoses(const std::filesystem::path& path,
                                                         LeftOut& left_out) {
  constexpr std::int64_t kMaxStamp = std::numeric_limits<std::int64_t>::max();
  const auto columns = WithMatrix({{"frame"}, {"timestamp_ns", /*optional=*/true}});
  std::vector<TablePose> rows;
  const auto visit = [&](Row& row) {
    const auto frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
    const std::int64_t stamp_ns =
        row.Has(1) ? row.Integer(1, 0, kMaxStamp) : frame * kNanosecondsPerFrame;
    const absl::StatusOr<Pose> T_W_S = TakePose(row, 2);
    if (!T_W_S.ok()) return T_W_S.status();
    rows.push_back({{frame, TimeFromNanoseconds(stamp_ns), *T_W_S}, row.line()});
    return absl::OkStatus();
  };
  if (auto status = VisitTable(path, {}, columns, left_out, visit); !status.ok()) return status;
  if (rows.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no pose under the header"));
  }
  return InOrder(path, std::move(rows), left_out);
}

absl::StatusOr<std::vector<RecordedBox>> ReadLidarBoxes(const std::filesystem::path& path,
                                                        const std::vector<RecordedPose>& poses,
                                                        LeftOut& left_out) {
  const auto columns =
      WithMatrix({{"frame"}, {"track"}, {"type"}, {"l"}, {"w"}, {"h"}, {"n_points"}});
  BoxRows boxes;
  const auto visit = [&](Row& row) {
    absl::StatusOr<RecordedBox> box = TakeBox(row);
    if (!box.ok()) return box.status();
    if (PoseOf(poses, box->frame) == nullptr) {
      return row.Error(absl::StrCat("frame ", box->frame, " has no pose of the sensor"));
    }
    return boxes.Add(row, *std::move(box));
  };
  if (auto status = VisitTable(path, {}, columns, left_out, visit); !status.ok()) return status;
  return boxes.Take();
}

}  // namespace clearway
