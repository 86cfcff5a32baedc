#include "io/dynosam_logs.h"

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "io/header_table.h"
#include "io/lidar_frames.h"
#include "io/lidar_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr char kCameraLog[] = "_camera_pose_log.csv";
constexpr char kFrontend[] = "frontend";
constexpr std::uint64_t kMaxPoseBytes = std::uint64_t{1} << 28;
constexpr std::uint64_t kMaxPointBytes = std::uint64_t{1} << 30;
constexpr std::size_t kMaxPoints = 20'000'000;
constexpr std::int64_t kMaxFrame = 99'999'999;
constexpr std::int64_t kMaxId = std::numeric_limits<ObjectId>::max();
// GenericValueTrack::MeaninglessFrame, the greatest size_t.
constexpr char kNoFrame[] = "18446744073709551615";

// Without what is hidden: other systems put files like ._a.csv beside a.csv.
bool IsCameraLog(const Path& path) {
  std::error_code error;
  const std::string name = path.filename().string();
  return name.ends_with(kCameraLog) && !name.starts_with('.') &&
         std::filesystem::is_regular_file(path, error);
}

std::string ModuleOf(const Path& camera_log) {
  const std::string name = camera_log.filename().string();
  return name.substr(0, name.size() - (sizeof(kCameraLog) - 1));
}

std::set<std::string> ModulesIn(const Path& folder) {
  std::set<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (IsCameraLog(entry->path())) names.insert(ModuleOf(entry->path()));
  }
  return names;
}

using Stamps = std::map<std::int64_t, Time>;

// DynoSAM's fork ends no last line.
HeaderFormat LogFormat(std::uint64_t max_bytes) { return {max_bytes, LastLine::kMayBeOpen}; }

// Those named, then a pose.
std::vector<WantedColumn> WithPose(std::vector<WantedColumn> columns) {
  for (const char* name : {"tx", "ty", "tz", "qx", "qy", "qz", "qw"}) columns.push_back({name});
  return columns;
}

absl::StatusOr<Stamps> ReadStamps(const Path& path, LeftOut& left_out) {
  const std::vector<WantedColumn> columns = {{"frame_id"}, {"timestamp [ns]"}};
  Stamps stamps;
  const auto visit = [&](Row& row) {
    const std::int64_t frame = row.Integer(0, 0, kMaxFrame);
    const Time stamp = TimeFromNanoseconds(row.Integer(1, 0, kFarthest_ns));
    if (!row.status().ok() || stamps.try_emplace(frame, stamp).second) return row.status();
    return row.Error(absl::StrCat("a second row of frame ", frame));
  };
  const auto status = VisitTable(path, LogFormat(kMaxPoseBytes), columns, left_out, visit);
  if (!status.ok()) return status;
  return stamps;
}

}  // namespace

Path DynosamModule::Log(const char* what) const {
  return folder / absl::StrCat(name, "_", what, "_log.csv");
}

absl::StatusOr<DynosamModule> FindDynosamModule(const Path& path) {
  if (IsCameraLog(path)) return DynosamModule{path.parent_path(), ModuleOf(path)};
  std::set<std::string> names = ModulesIn(path);
  if (names.empty()) {
    return absl::NotFoundError(absl::StrCat(path.string(), ": no *", kCameraLog, " is there"));
  }
  if (names.size() > 1) names.erase(kFrontend);
  if (names.size() > 1) {
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": logs of several modules, ", absl::StrJoin(names, ", "),
        "; name one by its file, as in ", (path / *names.begin()).string(), kCameraLog));
  }
  return DynosamModule{path, *names.begin()};
}

absl::StatusOr<std::vector<RecordedPose>> ReadDynosamCamera(const DynosamModule& module,
                                                            Duration period, LeftOut& left_out) {
  constexpr std::size_t kStamp = 8;
  auto columns = WithPose({{"frame_id"}});
  columns.push_back({"timestamp", /*optional=*/true});
  const Path stamp_path = module.folder / "frame_id_timestamp.csv";
  std::error_code error;
  const bool listed = std::filesystem::exists(stamp_path, error);
  const auto stamps = listed ? ReadStamps(stamp_path, left_out) : Stamps();
  if (!stamps.ok()) return stamps.status();
  std::vector<TablePose> rows;
  const auto stamp_of = [&](Row& row, std::int64_t frame) -> absl::StatusOr<Time> {
    if (row.Has(kStamp)) return TimeFromNanoseconds(row.Integer(kStamp, 0, kFarthest_ns));
    if (!listed) return TimeFromNanoseconds(frame * period.count());
    if (const auto stamp = stamps->find(frame); stamp != stamps->end()) return stamp->second;
    return row.Error(absl::StrCat("frame ", frame, " has no row in ", stamp_path.string()));
  };
  const auto visit = [&](Row& row) {
    const auto frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
    const Pose T_W_S = row.PoseFrom(1);
    const auto stamp = stamp_of(row, frame);
    if (!row.status().ok()) return row.status();
    if (!stamp.ok()) return stamp.status();
    rows.push_back({{frame, *stamp, T_W_S}, row.line()});
    return absl::OkStatus();
  };
  const Path path = module.Log("camera_pose");
  const auto status = VisitTable(path, LogFormat(kMaxPoseBytes), columns, left_out, visit);
  if (!status.ok()) return status;
  if (rows.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no pose under the header"));
  }
  return InOrder(path, std::move(rows), left_out);
}

absl::StatusOr<DynosamObjects> ReadDynosamObjects(const Path& path, LeftOut& left_out) {
  DynosamObjects objects;
  const auto visit = [&](Row& row) {
    const auto frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
    const auto id = static_cast<ObjectId>(row.Integer(1, 1, kMaxId));
    const Pose pose = row.PoseFrom(2);
    if (!row.status().ok() || objects.try_emplace({frame, id}, pose).second) return row.status();
    return row.Error(absl::StrCat("a second row of object ", id, " in frame ", frame));
  };
  const auto status = VisitTable(path, LogFormat(kMaxPoseBytes),
                                 WithPose({{"frame_id"}, {"object_id"}}), left_out, visit);
  if (!status.ok()) return status;
  return objects;
}

absl::StatusOr<DynosamPoints> ReadDynosamPoints(const Path& path,
                                                const std::vector<RecordedPose>& poses,
                                                LeftOut& left_out) {
  const std::vector<WantedColumn> columns = {
      {"frame_id"}, {"object_id"}, {"x_world"}, {"y_world"}, {"z_world"}};
  DynosamPoints points;
  std::size_t count = 0;
  const auto visit = [&](Row& row) -> absl::Status {
    const auto id = static_cast<ObjectId>(row.Integer(1, 0, kMaxId));
    const Eigen::Vector3d p_W(row.Number(2), row.Number(3), row.Number(4));
    if (++count > kMaxPoints) {
      return absl::ResourceExhaustedError(
          absl::StrCat(path.string(), ": more than ", kMaxPoints, " points"));
    }
    if (id == kStaticLabel && row.Text(0) == kNoFrame) {
      if (row.status().ok()) points.unframed_W.push_back(p_W);
      return row.status();
    }
    const RecordedPose* const pose = PoseOf(poses, row.Integer(0, 0, kMaxFrame));
    if (!row.status().ok()) return row.status();
    if (pose == nullptr) {
      ++points.without_pose;
      return absl::OkStatus();
    }
    DynosamCloud& cloud = points.clouds[pose->frame];
    cloud.points_S.push_back((Inverse(pose->T_W_S) * p_W).cast<float>());
    cloud.labels.push_back(id);
    return absl::OkStatus();
  };
  const auto status = VisitTable(path, LogFormat(kMaxPointBytes), columns, left_out, visit);
  if (!status.ok()) return status;
  return points;
}

}  // namespace clearway
