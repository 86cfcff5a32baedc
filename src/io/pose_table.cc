#include "io/pose_table.h"

#include <functional>
#include <optional>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "io/rigid_matrix.h"
#include "io/word_table.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kTumWords = 8, kKittiWords = 12;
constexpr WordFormat kTum{LastLine::kEnds, Comments::kHash, Separators::kCommasToo};
constexpr WordFormat kKitti{
    .last = LastLine::kEnds, .comments = Comments::kHash, .blanks = BlankLines::kRows};
constexpr WordFormat kTimes{.last = LastLine::kMayBeOpen, .blanks = BlankLines::kRows};

// Visits every row with its number, from 0.
absl::StatusOr<std::size_t> VisitNumbered(
    const Path& path, const WordFormat& format, LeftOut& left_out,
    const std::function<absl::Status(Row&, int number)>& visit) {
  auto words = ReadWordRows(path, format);
  if (!words.ok()) return words.status();
  RowPolicy policy(left_out);
  int number = 0;
  for (Row& row : words->rows) {
    const auto numbered = [&](Row& visited) { return visit(visited, number); };
    if (auto status = policy.Visit(row, numbered); !status.ok()) return status;
    ++number;
  }
  if (auto status = policy.Finish(); !status.ok()) return status;
  return words->rows.size();
}

absl::StatusOr<PoseTable> ReadTumPoses(const Path& path, LeftOut& left_out) {
  PoseTable table;
  table.stamped = true;
  const auto visit = [&](Row& row, int number) {
    if (row.size() != kTumWords) return row.WrongCount("timestamp tx ty tz qx qy qz qw");
    const RecordedPose pose{number, row.Stamp(0), row.PoseFrom(1)};
    if (row.status().ok()) table.rows.push_back({pose, row.line()});
    return row.status();
  };
  const auto count = VisitNumbered(path, kTum, left_out, visit);
  if (!count.ok()) return count.status();
  table.row_count = *count;
  return table;
}

absl::StatusOr<PoseTable> ReadMatrices(const Path& path, LeftOut& left_out) {
  PoseTable table;
  const auto visit = [&](Row& row, int number) {
    if (row.size() != kKittiWords) return row.WrongCount("12 (a matrix 3x4, row by row)");
    Eigen::Matrix<double, 3, 4> matrix;
    for (int i = 0; i < 12; ++i) {
      matrix(i / 4, i % 4) = row.Coordinate(static_cast<std::size_t>(i));
    }
    if (!row.status().ok()) return row.status();
    const auto pose = PoseOfMatrix(matrix, row.where());
    if (!pose.ok()) return pose.status();
    table.rows.push_back({{number, Time(), *pose}, row.line()});
    return absl::OkStatus();
  };
  const auto count = VisitNumbered(path, kKitti, left_out, visit);
  if (!count.ok()) return count.status();
  if (*count == 0) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": holds no pose"));
  }
  table.row_count = *count;
  return table;
}

struct LineTime {
  Time stamp;
  int line = 0;
};

// None for bad rows.
absl::StatusOr<std::vector<std::optional<LineTime>>> ReadTimes(const Path& path,
                                                               LeftOut& left_out) {
  std::vector<std::optional<LineTime>> times;
  const auto visit = [&](Row& row, int number) {
    times.resize(static_cast<std::size_t>(number) + 1);
    if (row.size() != 1) return row.WrongCount("one, seconds");
    const Time stamp = row.Stamp(0);
    if (row.status().ok()) times.back() = LineTime{stamp, row.line()};
    return row.status();
  };
  const auto count = VisitNumbered(path, kTimes, left_out, visit);
  if (!count.ok()) return count.status();
  times.resize(*count);
  return times;
}

}  // namespace

absl::StatusOr<PoseTable> ReadPoseTable(const Path& path, Duration period, LeftOut& left_out) {
  WordFormat format = kTum;
  format.last = LastLine::kMayBeOpen;
  auto words = ReadWordRows(path, format);
  if (!words.ok()) return words.status();
  if (words->rows.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": holds no pose"));
  }
  Row& first = words->rows.front();
  if (first.size() == kKittiWords) {
    return ReadKittiPoses(path, path.parent_path() / "times.txt", period, left_out);
  }
  if (first.size() == kTumWords) return ReadTumPoses(path, left_out);
  return first.WrongCount("8 (timestamp tx ty tz qx qy qz qw) or 12 (a matrix 3x4, row by row)");
}

absl::StatusOr<PoseTable> ReadKittiPoses(const Path& path, const Path& times_path, Duration period,
                                         LeftOut& left_out) {
  auto table = ReadMatrices(path, left_out);
  if (!table.ok()) return table.status();
  std::error_code error;
  table->stamped = std::filesystem::exists(times_path, error);
  if (!table->stamped) {
    for (TablePose& row : table->rows) row.pose.stamp = Time() + row.pose.frame * period;
    return table;
  }
  table->times_path = times_path;
  const auto times = ReadTimes(times_path, left_out);
  if (!times.ok()) return times.status();
  if (times->size() < table->row_count) {
    return absl::InvalidArgumentError(absl::StrCat(times_path.string(), ": ", times->size(),
                                                   " times for the ", table->row_count,
                                                   " poses of ", path.string()));
  }
  std::erase_if(table->rows, [&](TablePose& row) {
    const std::optional<LineTime>& time = (*times)[static_cast<std::size_t>(row.pose.frame)];
    if (!time) return true;
    row.pose.stamp = time->stamp;
    row.stamp_line = time->line;
    return false;
  });
  return table;
}

}  // namespace clearway
