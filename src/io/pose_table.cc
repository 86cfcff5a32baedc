#include "io/pose_table.h"

#include <system_error>

#include "absl/strings/str_cat.h"
#include "io/rigid_matrix.h"
#include "io/tum_tables.h"
#include "io/word_lines.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kTumWords = 8, kKittiWords = 12;

absl::StatusOr<PoseTable> StampedTable(const Path& path) {
  const auto track = ReadTumTrack(path);
  if (!track.ok()) return track.status();
  PoseTable table{{}, true};
  for (const TumPose& pose : *track) table.rows.push_back({pose.stamp, pose.T_W_X});
  return table;
}

absl::StatusOr<std::vector<Pose>> ReadMatrices(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kEnds, Comments::kHash);
  if (!lines.ok()) return lines.status();
  std::vector<Pose> poses;
  for (Words& line : *lines) {
    if (line.size() != kKittiWords) return WrongCount(line, "12 (a matrix 3x4, row by row)");
    Eigen::Matrix<double, 3, 4> matrix;
    for (int i = 0; i < 12; ++i) {
      matrix(i / 4, i % 4) = line.Number(static_cast<std::size_t>(i));
    }
    if (!line.status().ok()) return line.status();
    const auto pose = PoseOfMatrix(matrix, line.where());
    if (!pose.ok()) return pose.status();
    poses.push_back(*pose);
  }
  if (poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": holds no pose"));
  }
  return poses;
}

absl::StatusOr<std::vector<Time>> ReadTimes(const Path& path) {
  auto lines = ReadWordLines(path, LastLine::kMayBeOpen);
  if (!lines.ok()) return lines.status();
  std::vector<Time> times;
  for (Words& line : *lines) {
    if (line.size() != 1) return WrongCount(line, "one, seconds");
    const Time stamp = line.Stamp(0);
    if (!line.status().ok()) return line.status();
    if (!times.empty() && stamp <= times.back()) {
      return absl::InvalidArgumentError(
          absl::StrCat(line.where(), ": the stamp ", ToNanoseconds(stamp),
                       " ns does not come after ", ToNanoseconds(times.back()), " ns"));
    }
    times.push_back(stamp);
  }
  return times;
}

}  // namespace

absl::StatusOr<PoseTable> ReadPoseTable(const Path& path, Duration period) {
  const auto lines = ReadWordLines(path, LastLine::kMayBeOpen, Comments::kHash);
  if (!lines.ok()) return lines.status();
  if (lines->empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": holds no pose"));
  }
  const std::size_t words = lines->front().size();
  if (words == kKittiWords) return ReadKittiPoses(path, path.parent_path() / "times.txt", period);
  if (words == kTumWords || lines->front().Text(0).find(',') != std::string::npos) {
    return StampedTable(path);
  }
  return WrongCount(lines->front(),
                    "8 (timestamp tx ty tz qx qy qz qw) or 12 (a matrix 3x4, row by row)");
}

absl::StatusOr<PoseTable> ReadKittiPoses(const Path& path, const Path& times_path,
                                         Duration period) {
  const auto poses = ReadMatrices(path);
  if (!poses.ok()) return poses.status();
  PoseTable table;
  std::error_code error;
  table.stamped = std::filesystem::exists(times_path, error);
  const auto times = table.stamped ? ReadTimes(times_path) : std::vector<Time>();
  if (!times.ok()) return times.status();
  if (table.stamped && times->size() < poses->size()) {
    return absl::InvalidArgumentError(absl::StrCat(times_path.string(), ": ", times->size(),
                                                   " times for the ", poses->size(), " poses of ",
                                                   path.string()));
  }
  for (std::size_t k = 0; k < poses->size(); ++k) {
    const Time stamp = table.stamped ? (*times)[k] : Time() + static_cast<int>(k) * period;
    table.rows.push_back({stamp, (*poses)[k]});
  }
  return table;
}

}  // namespace clearway
