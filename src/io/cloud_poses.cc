#include "io/cloud_poses.h"

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "io/lidar_tables.h"
#include "io/tum_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

std::string NoPose(const Path& cloud, const Path& table_path) {
  return absl::StrCat(cloud.string(), ": no usable pose in ", table_path.filename().string());
}

PosedClouds PosedByStamps(const NamedClouds& named, const PoseTable& table, const Path& table_path,
                          LeftOut& left_out) {
  TumTrack track;
  const bool timed = !table.times_path.empty();
  for (const TablePose& row : table.rows) {
    track.push_back({row.pose.stamp, row.pose.T_W_S, timed ? row.stamp_line : row.line});
  }
  SortByStamp(timed ? table.times_path : table_path, track, left_out);
  PosedClouds posed;
  posed.how = "at the stamps that name the clouds";
  for (std::size_t i = 0; i < named.clouds.size(); ++i) {
    const auto pose = PoseAt(track, named.clouds[i].stamp);
    if (!pose) {
      ++posed.without_pose;
      left_out.AddFrame(NoPose(named.clouds[i].path, table_path));
      continue;
    }
    const int frame = static_cast<int>(i);
    posed.clouds[frame] = named.clouds[i].path;
    posed.poses.push_back({frame, named.clouds[i].stamp, *pose});
  }
  return posed;
}

absl::StatusOr<PosedClouds> PosedByRows(const NamedClouds& named, const PoseTable& table,
                                        const Path& table_path, const std::string& folder,
                                        LeftOut& left_out) {
  const auto rows = RowsOf(named, table.row_count, folder);
  if (!rows.ok()) return rows.status();
  std::map<int, Path> of_rows;
  for (std::size_t i = 0; i < rows->of_clouds.size(); ++i) {
    const std::optional<std::size_t> row = rows->of_clouds[i];
    if (row) of_rows[static_cast<int>(*row)] = named.clouds[i].path;
  }
  std::vector<TablePose> used = table.rows;
  std::erase_if(used, [&](const TablePose& row) { return !of_rows.contains(row.pose.frame); });
  PosedClouds posed;
  posed.how = rows->by_number ? "of the rows that number the clouds" : "in the clouds' order";
  posed.poses = InOrder(table_path, std::move(used), left_out, table.times_path);
  for (const RecordedPose& pose : posed.poses) {
    posed.clouds[pose.frame] = std::move(of_rows.at(pose.frame));
  }
  std::set<Path> with_pose;
  for (const auto& [frame, path] : posed.clouds) with_pose.insert(path);
  for (const NamedCloud& cloud : named.clouds) {
    if (with_pose.contains(cloud.path)) continue;
    ++posed.without_pose;
    left_out.AddFrame(NoPose(cloud.path, table_path));
  }
  return posed;
}

std::string SpanText(Time first, Time last) {
  return absl::StrFormat("from %.2f to %.2f s", ToSeconds(first - Time()),
                         ToSeconds(last - Time()));
}

// Says how the names were read: they may be of another kind.
absl::Status NoPoses(const Path& folder, const NamedClouds& named, const PoseTable& table,
                     const Path& table_path) {
  std::string text = absl::StrCat(folder.string(), ": none of ", named.clouds.size(),
                                  " clouds has a pose in ", table_path.string());
  if (named.naming == CloudNaming::kStamps && table.stamped && !table.rows.empty()) {
    const auto [first, last] = std::ranges::minmax_element(
        table.rows, {}, [](const TablePose& row) { return row.pose.stamp; });
    absl::StrAppend(&text, "; their names were read as stamps ",
                    SpanText(named.clouds.front().stamp, named.clouds.back().stamp),
                    ", the table's stamps are ", SpanText(first->pose.stamp, last->pose.stamp),
                    ". Names that number the table's rows (0.pcd, 1.pcd, ...) need no stamps");
  } else if (named.naming == CloudNaming::kNumbers) {
    absl::StrAppend(&text, "; their names were read as numbers of its ", table.row_count,
                    " rows, counted from 0, from ", named.clouds.front().number, " to ",
                    named.clouds.back().number,
                    ". Stamps have a decimal point or 10, 13, 16 or 19 digits");
  }
  return absl::InvalidArgumentError(text);
}

// Whether the clouds' numbers, in ascending order, can be those of rows.
bool NumberRows(const std::vector<NamedCloud>& clouds, std::size_t rows) {
  return clouds.front().number >= 0 && clouds.back().number < static_cast<std::int64_t>(rows);
}

absl::StatusOr<PosedClouds> Associate(const NamedClouds& named, const PoseTable& table,
                                      const Path& table_path, const std::string& folder,
                                      LeftOut& left_out) {
  if (named.naming != CloudNaming::kStamps) {
    return PosedByRows(named, table, table_path, folder, left_out);
  }
  if (table.stamped) return PosedByStamps(named, table, table_path, left_out);
  // Without stamps in the table, the names are no stamps either.
  NamedClouds unstamped = named;
  const bool numbers = NumberRows(named.clouds, table.row_count);
  unstamped.naming = numbers ? CloudNaming::kNumbers : CloudNaming::kOther;
  if (numbers || named.clouds.size() == table.row_count) {
    return PosedByRows(unstamped, table, table_path, folder, left_out);
  }
  return absl::InvalidArgumentError(
      absl::StrCat(folder, ": ", named.clouds.size(), " clouds are named by their stamps, but the ",
                   table.row_count, " poses of ", table_path.string(), " have none"));
}

}  // namespace

absl::StatusOr<PosedClouds> PoseClouds(const NamedClouds& named, const PoseTable& table,
                                       const Path& table_path, const Path& folder,
                                       LeftOut& left_out) {
  auto posed = Associate(named, table, table_path, folder.string(), left_out);
  if (posed.ok() && posed->poses.empty()) return NoPoses(folder, named, table, table_path);
  return posed;
}

}  // namespace clearway
