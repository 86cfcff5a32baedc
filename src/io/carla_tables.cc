#include "io/carla_tables.h"

#include <limits>
#include <numbers>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "io/header_table.h"
#include "io/lidar_frames.h"
#include "io/lidar_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::int64_t kMaxFrame = 99'999'999;
constexpr std::int64_t kMaxId = std::numeric_limits<ObjectId>::max();
constexpr double kFullTurn_deg = 360, kMaxSeconds = 4e9;
constexpr char kEgo[] = "ego";

// Those named, then x to yaw.
std::vector<WantedColumn> WithTransform(std::vector<WantedColumn> columns) {
  for (const char* name : {"x", "y", "z", "roll", "pitch", "yaw"}) columns.push_back({name});
  return columns;
}

Eigen::Vector3d TakeMetres(Row& row, std::size_t first) {
  return {row.Coordinate(first), row.Coordinate(first + 1), row.Coordinate(first + 2)};
}

// x to yaw, which begin at a column.
Pose TakePose(Row& row, std::size_t first) {
  return FromCarla(CarlaTransform{.location_m = TakeMetres(row, first),
                                  .roll_deg = row.NumberWithin(first + 3, kFullTurn_deg),
                                  .pitch_deg = row.NumberWithin(first + 4, kFullTurn_deg),
                                  .yaw_deg = row.NumberWithin(first + 5, kFullTurn_deg)});
}

constexpr std::size_t kTransform = 3, kBox = 9;  // columns of actors

// Moves B from the actor's origin to the middle of its box. CARLA has actors without extents: a
// length of 0 says nothing.
absl::Status TakeBox(Row& row, RecordedBox& box) {
  const Eigen::Vector3d middle = TakeMetres(row, kBox);
  const Eigen::Vector3d extent = TakeMetres(row, kBox + 3);
  if (!row.status().ok()) return row.status();
  if ((extent.array() < 0).any()) {
    return row.Error(absl::StrCat("columns extent_x, extent_y, extent_z: ", NumberText(extent.x()),
                                  ", ", NumberText(extent.y()), ", ", NumberText(extent.z()),
                                  "; none may be below 0"));
  }
  box.T_W_B = box.T_W_B * FromCarla(CarlaTransform{.location_m = middle});
  if ((extent.array() > 0).all()) box.size_m = 2 * extent;
  return absl::OkStatus();
}

absl::StatusOr<RecordedBox> ReadActor(Row& row) {
  RecordedBox box;
  box.frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
  box.id = static_cast<ObjectId>(row.Integer(1, 1, kMaxId));
  box.type = row.PlainText(2);
  box.T_W_B = TakePose(row, kTransform);
  box.n_points = -1;  // not said
  if (!row.status().ok()) return row.status();
  if (row.Has(kBox)) {
    if (auto status = TakeBox(row, box); !status.ok()) return status;
  }
  return box;
}

std::vector<WantedColumn> ActorColumns() {
  auto columns = WithTransform({{"frame"}, {"id"}, {"type"}});
  for (const char* name : {"box_x", "box_y", "box_z", "extent_x", "extent_y", "extent_z"}) {
    columns.push_back({name, /*optional=*/true});
  }
  return columns;
}

}  // namespace

Pose FromCarla(const CarlaTransform& transform) {
  constexpr double kRadians = std::numbers::pi / 180;
  using Axis = Eigen::AngleAxisd;
  const Eigen::Vector3d& p = transform.location_m;
  return {Axis(-transform.yaw_deg * kRadians, Eigen::Vector3d::UnitZ()) *
              Axis(-transform.pitch_deg * kRadians, Eigen::Vector3d::UnitY()) *
              Axis(transform.roll_deg * kRadians, Eigen::Vector3d::UnitX()),
          {p.x(), -p.y(), p.z()}};
}

absl::StatusOr<std::vector<RecordedPose>> ReadCarlaSensor(const Path& path, LeftOut& left_out) {
  const auto columns = WithTransform({{"frame"}, {"timestamp"}});
  std::vector<TablePose> rows;
  const auto visit = [&](Row& row) {
    RecordedPose pose;
    pose.frame = static_cast<int>(row.Integer(0, 0, kMaxFrame));
    pose.stamp = Time(FromSeconds(row.NumberBetween(1, 0, kMaxSeconds)));
    pose.T_W_S = TakePose(row, 2);
    if (row.status().ok()) rows.push_back({pose, row.line()});
    return row.status();
  };
  if (auto status = VisitTable(path, {}, columns, left_out, visit); !status.ok()) return status;
  if (rows.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no row under the header"));
  }
  return InOrder(path, std::move(rows), left_out);
}

absl::StatusOr<CarlaActors> ReadCarlaActors(const Path& path,
                                            const std::vector<RecordedPose>& poses,
                                            LeftOut& left_out) {
  CarlaActors actors;
  BoxRows boxes;
  const auto visit = [&](Row& row) {
    absl::StatusOr<RecordedBox> box = ReadActor(row);
    if (!box.ok()) return box.status();
    if (box->type == kEgo) {
      actors.ego.insert(box->id);
      return absl::OkStatus();
    }
    const ObjectId id = box->id;
    if (PoseOf(poses, box->frame) == nullptr) {
      ++actors.without_pose;
    } else if (auto status = boxes.Add(row, *std::move(box)); !status.ok()) {
      return status;
    }
    actors.objects.insert(id);
    return absl::OkStatus();
  };
  if (auto status = VisitTable(path, {}, ActorColumns(), left_out, visit); !status.ok()) {
    return status;
  }
  for (const ObjectId id : actors.ego) {
    if (!actors.objects.contains(id)) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": actor ", id, " is of type ego in some rows and of others in others"));
  }
  actors.boxes = boxes.Take();
  return actors;
}

}  // namespace clearway
