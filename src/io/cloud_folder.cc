#include "clearway/io/cloud_folder.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "io/cloud_names.h"
#include "io/cloud_points.h"
#include "io/lidar_frames.h"
#include "io/pose_table.h"
#include "io/tum_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr const char* kTableNames[] = {"poses.txt",       "poses.tum",       "poses_tum.txt",
                                       "poses_kitti.txt", "groundtruth.txt", "trajectory.txt",
                                       "trajectory.tum",  "traj.txt",        "odometry.txt"};

bool IsCloud(const Path& path) {
  const std::string extension = absl::AsciiStrToLower(path.extension().string());
  return extension == ".pcd" || extension == ".ply";
}

std::vector<Path> EntriesOf(const Path& folder) {
  std::vector<Path> entries;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::ranges::sort(entries);
  return entries;
}

std::vector<Path> CloudsIn(const Path& folder) {
  std::vector<Path> clouds = EntriesOf(folder);
  std::erase_if(clouds, [](const Path& path) {
    std::error_code error;
    return !IsCloud(path) || !std::filesystem::is_regular_file(path, error);
  });
  return clouds;
}

// The folders with clouds: the given one, else those in it.
std::vector<Path> FoldersOfClouds(const Path& folder) {
  if (!CloudsIn(folder).empty()) return {folder};
  std::vector<Path> folders = EntriesOf(folder);
  std::erase_if(folders, [](const Path& path) {
    std::error_code error;
    return !std::filesystem::is_directory(path, error) || CloudsIn(path).empty();
  });
  return folders;
}

absl::StatusOr<Path> FindTable(const Path& folder, const Path& clouds, const Path& asked) {
  std::error_code error;
  if (!asked.empty()) return asked;
  std::vector<Path> found;
  for (const Path& place : {folder, clouds, folder.parent_path()}) {
    for (const char* name : kTableNames) {
      if (std::filesystem::is_regular_file(place / name, error)) found.push_back(place / name);
    }
    if (!found.empty()) break;
  }
  if (found.size() == 1) return found.front();
  const auto name_of = [](std::string* out, const Path& path) { *out += path.string(); };
  if (found.empty()) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": point clouds, but no table of the sensor's poses (",
                     absl::StrJoin(kTableNames, ", "), "); --pose-table names one"));
  }
  return absl::InvalidArgumentError(absl::StrCat(
      folder.string(), ": several tables of poses: ", absl::StrJoin(found, ", ", name_of),
      "; --pose-table names the one to use"));
}

absl::StatusOr<CloudPoints> ReadCloud(const Path& path, const std::string& label_field) {
  const bool is_ply = absl::AsciiStrToLower(path.extension().string()) == ".ply";
  return is_ply ? ReadPlyCloud(path, label_field) : ReadPcd(path, label_field);
}

// Points of a map in W would be far from the sensor as soon as that is far from W's origin.
absl::Status CheckInSensorFrame(const Path& path, const std::vector<Eigen::Vector3f>& points_S) {
  constexpr float kFarthest_m = 1e5f;
  std::size_t finite = 0;
  for (const Eigen::Vector3f& p_S : points_S) {
    if (!p_S.allFinite()) continue;
    if (p_S.cwiseAbs().maxCoeff() <= kFarthest_m) return absl::OkStatus();
    ++finite;
  }
  if (finite == 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(path.string(), ": every point is more than ", kFarthest_m,
                   " m away; clouds are expected in the sensor's frame, not in the world's"));
}

absl::Status Fill(const Path& path, const std::string& label_field, Frame& frame) {
  absl::StatusOr<CloudPoints> cloud = ReadCloud(path, label_field);
  if (!cloud.ok()) return cloud.status();
  frame.points_S = std::move(cloud->points_S);
  frame.labels = std::move(cloud->labels);
  return CheckInSensorFrame(path, frame.points_S);
}

// The clouds that become frames.
struct Posed {
  std::map<int, Path> clouds;  // by the frame's number
  std::vector<RecordedPose> poses;
  std::string how;  // clouds got their poses
  std::size_t without_pose = 0;
};

std::string NoPose(const Path& cloud, const Path& table_path) {
  return absl::StrCat(cloud.string(), ": no usable pose in ", table_path.filename().string());
}

Posed PosedByStamps(const NamedClouds& named, const PoseTable& table, const Path& table_path,
                    LeftOut& left_out) {
  TumTrack track;
  const bool timed = !table.times_path.empty();
  for (const TablePose& row : table.rows) {
    track.push_back({row.pose.stamp, row.pose.T_W_S, timed ? row.stamp_line : row.line});
  }
  SortByStamp(timed ? table.times_path : table_path, track, left_out);
  Posed posed;
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

absl::StatusOr<Posed> PosedByRows(const NamedClouds& named, const PoseTable& table,
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
  Posed posed;
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

absl::StatusOr<Posed> Associate(const NamedClouds& named, const PoseTable& table,
                                const Path& table_path, const std::string& folder,
                                LeftOut& left_out) {
  if (named.naming != CloudNaming::kStamps) {
    return PosedByRows(named, table, table_path, folder, left_out);
  }
  if (table.stamped) return PosedByStamps(named, table, table_path, left_out);
  if (named.clouds.size() == table.row_count) {
    NamedClouds in_order = named;
    in_order.naming = CloudNaming::kOther;
    return PosedByRows(in_order, table, table_path, folder, left_out);
  }
  return absl::InvalidArgumentError(
      absl::StrCat(folder, ": ", named.clouds.size(), " clouds are named by their stamps, but the ",
                   table.row_count, " poses of ", table_path.string(), " have none"));
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
                    ". Stamps have a decimal point or 10, 13, 16 or 19 "
                    "digits");
  }
  return absl::InvalidArgumentError(text);
}

std::string Described(const std::string& name, const Posed& posed, const Path& table_path,
                      const CloudPoints& first, const std::string& label_field) {
  std::string text =
      absl::StrCat(name, "; poses of ", table_path.filename().string(), " ", posed.how);
  if (posed.without_pose > 0) {
    absl::StrAppend(&text, "; ", posed.without_pose, " clouds without a pose are left out");
  }
  if (first.has_viewpoint) absl::StrAppend(&text, "; VIEWPOINT is ignored");
  if (label_field.empty()) {
    absl::StrAppend(&text, "; no --label-field: all points are static (fields: ",
                    absl::StrJoin(first.fields, " "), ")");
  }
  return text;
}

}  // namespace

bool IsCloudFolder(const Path& folder) { return !FoldersOfClouds(folder).empty(); }

absl::StatusOr<LidarFolder> OpenCloudFolder(const Path& given, const CloudFolderOptions& options) {
  if (auto status = CheckFramePeriod(options.frame_period); !status.ok()) return status;
  std::error_code error;
  Path folder = std::filesystem::absolute(given, error).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::vector<Path> folders = FoldersOfClouds(folder);
  if (folders.size() != 1) {
    return absl::InvalidArgumentError(absl::StrCat(folder.string(), ": ", folders.size(),
                                                   " folders of point clouds; name one of them"));
  }
  const auto table_path = FindTable(folder, folders.front(), options.pose_table);
  if (!table_path.ok()) return table_path.status();
  LidarScans scans;
  const auto table = ReadPoseTable(*table_path, options.frame_period, *scans.left_out);
  if (!table.ok()) return table.status();
  const auto named = NameClouds(CloudsIn(folders.front()));
  if (!named.ok()) return named.status();
  auto posed = Associate(*named, *table, *table_path, folder.string(), *scans.left_out);
  if (!posed.ok()) return posed.status();
  if (posed->poses.empty()) return NoPoses(folder, *named, *table, *table_path);
  const auto first = ReadCloud(posed->clouds.begin()->second, options.label_field);
  if (!first.ok()) return first.status();

  scans.name = absl::StrCat("point clouds ", folders.front().string());
  scans.options = {.first_frame = options.first_frame,
                   .last_frame = options.last_frame,
                   .sensor_id = options.sensor_id};
  const std::string description =
      Described(scans.name, *posed, *table_path, *first, options.label_field);
  scans.poses = std::move(posed->poses);
  const auto clouds = std::make_shared<const std::map<int, Path>>(std::move(posed->clouds));
  scans.points_of = [clouds](int frame) { return clouds->at(frame); };
  scans.read = [field = options.label_field](const Path& path, std::span<const RecordedBox>,
                                             Frame& frame) { return Fill(path, field, frame); };
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
