#include "clearway/io/cloud_folder.h"

#include <algorithm>
#include <map>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "io/cloud_names.h"
#include "io/cloud_points.h"
#include "io/cloud_poses.h"
#include "io/lidar_frames.h"
#include "io/pose_table.h"

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

// Without what is hidden: other systems put files like ._1.pcd beside 1.pcd.
std::vector<Path> EntriesOf(const Path& folder) {
  std::vector<Path> entries;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (!entry->path().filename().string().starts_with('.')) entries.push_back(entry->path());
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

// The first that can be read: whether others can is for who reads them. Else why the first cannot,
// but of clouds without the field of labels the first of those, for the name may be mistyped.
absl::StatusOr<CloudPoints> FirstCloud(const std::map<int, Path>& clouds,
                                       const std::string& label_field) {
  absl::Status why, without_field;
  for (const auto& [frame, path] : clouds) {
    absl::StatusOr<CloudPoints> cloud = ReadCloud(path, label_field);
    if (cloud.ok()) return cloud;
    why.Update(cloud.status());
    if (without_field.ok() && ReadCloud(path, "").ok()) without_field = cloud.status();
  }
  return without_field.ok() ? why : without_field;
}

std::string Described(const std::string& name, const PosedClouds& posed, const Path& table_path,
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
  auto posed = PoseClouds(*named, *table, *table_path, folder, *scans.left_out);
  if (!posed.ok()) return posed.status();
  const auto first = FirstCloud(posed->clouds, options.label_field);
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
