#include "io/carla_tables.h"

#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "absl/strings/str_cat.h"
#include "clearway/io/world_origin.h"
#include "io/csv.h"
#include "io/lidar_frames.h"
#include "io/lidar_tables.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

constexpr std::int64_t kMaxFrame = 99'999'999;
constexpr std::int64_t kMaxId = std::numeric_limits<ObjectId>::max();
constexpr double kFarthest_m = kMaxFileCoordinate_m, kFullTurn_deg = 360, kMostSeconds = 4e9;
constexpr char kEgo[] = "ego";

template <std::size_t kSize>
using Columns = std::array<std::size_t, kSize>;

template <std::size_t kSize>
absl::StatusOr<Columns<kSize>> FindColumns(const CsvTable& table,
                                           const std::array<const char*, kSize>& names) {
  Columns<kSize> columns;
  for (std::size_t i = 0; i < kSize; ++i) {
    const auto column = table.Column(names[i]);
    if (!column.ok()) return column.status();
    columns[i] = *column;
  }
  return columns;
}

Eigen::Vector3d TakeMetres(CsvRow& row, std::span<const std::size_t, 3> columns) {
  return {row.NumberWithin(columns[0], kFarthest_m), row.NumberWithin(columns[1], kFarthest_m),
          row.NumberWithin(columns[2], kFarthest_m)};
}

absl::StatusOr<Columns<6>> FindTransform(const CsvTable& table) {
  return FindColumns<6>(table, {"x", "y", "z", "roll", "pitch", "yaw"});
}

Pose TakePose(CsvRow& row, const Columns<6>& columns) {
  return FromCarla(CarlaTransform{.location_m = TakeMetres(row, std::span(columns).first<3>()),
                                  .roll_deg = row.NumberWithin(columns[3], kFullTurn_deg),
                                  .pitch_deg = row.NumberWithin(columns[4], kFullTurn_deg),
                                  .yaw_deg = row.NumberWithin(columns[5], kFullTurn_deg)});
}

// Where the columns of the table of actors are.
struct ActorColumns {
  Columns<3> key;  // frame, id, type
  Columns<6> transform;
  std::optional<Columns<6>> box;  // where its middle is, and half of its lengths
};

absl::StatusOr<ActorColumns> FindActorColumns(const CsvTable& table) {
  const auto key = FindColumns<3>(table, {"frame", "id", "type"});
  if (!key.ok()) return key.status();
  const auto transform = FindTransform(table);
  if (!transform.ok()) return transform.status();
  ActorColumns columns{*key, *transform, std::nullopt};
  constexpr std::array<const char*, 6> kBox = {"box_x",    "box_y",    "box_z",
                                               "extent_x", "extent_y", "extent_z"};
  bool any = false;
  for (const char* name : kBox) any |= table.HasColumn(name);
  if (!any) return columns;
  const auto box = FindColumns<6>(table, kBox);
  if (!box.ok()) return box.status();
  columns.box = *box;
  return columns;
}

// Moves B from the actor's origin to the middle of its box. CARLA has actors without extents: a
// length of 0 says nothing.
absl::Status TakeBox(const CsvTable& table, std::size_t row, const Columns<6>& columns,
                     CsvRow& reader, RecordedBox& box) {
  const Eigen::Vector3d middle = TakeMetres(reader, std::span(columns).first<3>());
  const Eigen::Vector3d extent = TakeMetres(reader, std::span(columns).last<3>());
  if (!reader.status().ok()) return reader.status();
  if ((extent.array() < 0).any()) {
    return absl::InvalidArgumentError(
        absl::StrCat(table.Where(row), ", columns extent_x, extent_y, extent_z: ", extent.x(), ", ",
                     extent.y(), ", ", extent.z(), "; none may be below 0"));
  }
  box.T_W_B = box.T_W_B * FromCarla(CarlaTransform{.location_m = middle});
  if ((extent.array() > 0).all()) box.size_m = 2 * extent;
  return absl::OkStatus();
}

absl::StatusOr<RecordedBox> ReadActor(const CsvTable& table, std::size_t row,
                                      const ActorColumns& columns) {
  CsvRow reader(table, row);
  RecordedBox box;
  box.frame = static_cast<int>(reader.Integer(columns.key[0], 0, kMaxFrame));
  box.id = static_cast<ObjectId>(reader.Integer(columns.key[1], 1, kMaxId));
  box.type = reader.Text(columns.key[2]);
  box.T_W_B = TakePose(reader, columns.transform);
  box.n_points = -1;  // not said
  if (!reader.status().ok()) return reader.status();
  if (columns.box) {
    const absl::Status status = TakeBox(table, row, *columns.box, reader, box);
    if (!status.ok()) return status;
  }
  return box;
}

absl::Status CheckOrder(const CsvTable& table, std::size_t row, const RecordedPose& last,
                        const RecordedPose& pose) {
  if (pose.frame > last.frame && pose.stamp > last.stamp) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      table.Where(row), ": frame ", pose.frame, " at ", ToNanoseconds(pose.stamp),
      " ns does not come after frame ", last.frame, " at ", ToNanoseconds(last.stamp), " ns"));
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

absl::StatusOr<std::vector<RecordedPose>> ReadCarlaSensor(const Path& path) {
  const absl::StatusOr<CsvTable> table = CsvTable::Read(path);
  if (!table.ok()) return table.status();
  const auto key = FindColumns<2>(*table, {"frame", "timestamp"});
  if (!key.ok()) return key.status();
  const auto transform = FindTransform(*table);
  if (!transform.ok()) return transform.status();
  std::vector<RecordedPose> poses;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    CsvRow reader(*table, row);
    RecordedPose pose;
    pose.frame = static_cast<int>(reader.Integer((*key)[0], 0, kMaxFrame));
    const double seconds = reader.NumberBetween((*key)[1], 0, kMostSeconds);
    pose.T_W_S = TakePose(reader, *transform);
    if (!reader.status().ok()) return reader.status();
    pose.stamp = Time(FromSeconds(seconds));
    if (!poses.empty()) {
      const absl::Status status = CheckOrder(*table, row, poses.back(), pose);
      if (!status.ok()) return status;
    }
    poses.push_back(pose);
  }
  if (poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": no row under the header"));
  }
  return poses;
}

absl::StatusOr<CarlaActors> ReadCarlaActors(const Path& path,
                                            const std::vector<RecordedPose>& poses) {
  const absl::StatusOr<CsvTable> table = CsvTable::Read(path);
  if (!table.ok()) return table.status();
  const absl::StatusOr<ActorColumns> columns = FindActorColumns(*table);
  if (!columns.ok()) return columns.status();
  CarlaActors actors;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    absl::StatusOr<RecordedBox> box = ReadActor(*table, row, *columns);
    if (!box.ok()) return box.status();
    if (box->type == kEgo) {
      actors.ego.insert(box->id);
      continue;
    }
    actors.objects.insert(box->id);
    if (PoseOf(poses, box->frame) == nullptr) {
      ++actors.without_pose;
    } else {
      actors.boxes.push_back(*std::move(box));
    }
  }
  for (const ObjectId id : actors.ego) {
    if (!actors.objects.contains(id)) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": actor ", id, " is of type ego in some rows and of others in others"));
  }
  if (auto status = SortBoxes(path, actors.boxes); !status.ok()) return status;
  return actors;
}

}  // namespace clearway
