#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/io/file_type.h"
#include "clearway/io/recording.h"
#include "io/recording_codec.h"
#include "io/recording_origin.h"
#include "io/recording_schema.h"
#include "io/sqlite.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

absl::Status At(const Path& path, const std::string& where, const absl::Status& status) {
  return absl::Status(status.code(),
                      absl::StrCat(path.string(), where, ": ", std::string(status.message())));
}

std::uint32_t BigEndian(const unsigned char* bytes, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

// SQLite reads what is left of a file that was cut off for as long as it can. The header says how
// many pages there should be (https://www.sqlite.org/fileformat2.html, section 1.3).
absl::Status CheckWhole(const Path& path) {
  constexpr std::size_t kHeaderBytes = 100, kEnough = 512;
  const auto start = ReadFileStart(path, kEnough);
  if (!start.ok()) return start.status();
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  const std::string_view magic = std::string_view(*start).substr(0, kMagic.size());
  if (start->empty() || !kMagic.starts_with(magic)) {
    const std::string kind = KindOfFile(path).name;
    const bool may_be_cloud = LowerExtension(path) == ".pcd" || LowerExtension(path) == ".ply";
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": not a recording", kind.empty() ? "" : "; the file is ", kind,
        may_be_cloud ? "; give the folder that holds the clouds and the table of their poses"
                     : ""));
  }
  if (start->size() < kHeaderBytes) {
    return absl::DataLossError(absl::StrCat(path.string(), ": cut off: only ", start->size(),
                                            " bytes of the header are there"));
  }
  unsigned char header[kHeaderBytes];
  std::memcpy(header, start->data(), kHeaderBytes);
  const std::uint32_t stored = BigEndian(header + 16, 2);
  const std::uint64_t page_bytes = stored == 1 ? 65536 : stored;
  const std::uint64_t expected = page_bytes * BigEndian(header + 28, 4);
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error || size != expected) {
    return absl::DataLossError(absl::StrCat(path.string(), ": cut off or damaged: ", size,
                                            " bytes; its header says ", expected));
  }
  return absl::OkStatus();
}

absl::Status CheckKind(SqliteDatabase& database) {
  const auto application = database.QueryInteger("PRAGMA application_id");
  if (!application.ok()) return application.status();
  if (*application != kRecordingApplicationId) {
    const auto bag = database.QueryInteger(
        "SELECT count(*) FROM sqlite_master WHERE name IN ('topics', 'messages')");
    const bool is_bag = bag.ok() && *bag == 2;
    return absl::InvalidArgumentError(absl::StrCat(
        "not a recording; the file is ",
        is_bag ? "a ROS 2 bag" : "an SQLite database of another program", " (application_id ",
        *application, " instead of ", kRecordingApplicationId, ")"));
  }
  const auto version = database.QueryInteger("PRAGMA user_version");
  if (!version.ok()) return version.status();
  if (*version != kRecordingVersion) {
    return absl::FailedPreconditionError(absl::StrCat(
        "recording of version ", *version, "; this program reads version ", kRecordingVersion));
  }
  return absl::OkStatus();
}

absl::StatusOr<RecordedMeta> ReadMeta(SqliteDatabase& database) {
  auto statement =
      database.Prepare("SELECT description, resolution_m, frame_count, checksum FROM meta");
  if (!statement.ok()) return statement.status();
  const absl::StatusOr<bool> row = statement->Step();
  if (!row.ok()) return row.status();
  if (!*row) return absl::DataLossError("meta: no row");
  const RecordedMeta meta{std::string(statement->Bytes(0)), statement->Real(1),
                          statement->Integer(2)};
  if (ChecksumOf(meta) != statement->Integer(3)) {
    return absl::DataLossError("meta: damaged (its checksum does not fit)");
  }
  if (!(meta.resolution_m > 0) || !std::isfinite(meta.resolution_m)) {
    return absl::DataLossError(absl::StrCat("meta: resolution_m is ", NumberText(meta.resolution_m),
                                            "; it must be above 0"));
  }
  const auto count = database.QueryInteger("SELECT COUNT(*) FROM frame");
  if (!count.ok()) return count.status();
  if (meta.frame_count < 0 || *count != meta.frame_count) {
    return absl::DataLossError(
        absl::StrCat("frame_count: ", *count, " frames are there instead of ", meta.frame_count));
  }
  return meta;
}

// An open recording; shared by the copies of a FrameSource.
class Recording {
 public:
  static absl::StatusOr<std::shared_ptr<Recording>> Open(const Path& path) {
    absl::Status status = CheckWhole(path);
    if (!status.ok()) return status;
    auto database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kReadOnly);
    if (!database.ok()) return At(path, "", database.status());
    status = CheckKind(*database);
    if (!status.ok()) return At(path, "", status);
    auto meta = ReadMeta(*database);
    if (!meta.ok()) return At(path, "", meta.status());
    const auto origin_m = ReadRecordedOrigin(*database);
    if (!origin_m.ok()) return At(path, "", origin_m.status());
    auto select = database->Prepare(
        "SELECT number, sensor_id, sequence, stamp_ns, point_count, arrays, world_from_sensor, "
        "motions, poses, points, checksum FROM frame WHERE number = ?");
    if (!select.ok()) return At(path, "", select.status());
    return std::make_shared<Recording>(path, *std::move(database), *std::move(select),
                                       *std::move(meta), *origin_m);
  }

  Recording(Path path, SqliteDatabase database, SqliteStatement select, RecordedMeta meta,
            const Eigen::Vector3d& origin_m)
      : path_(std::move(path)),
        database_(std::move(database)),
        select_(std::move(select)),
        meta_(std::move(meta)),
        origin_m_(origin_m) {}

  const RecordedMeta& meta() const { return meta_; }
  const Eigen::Vector3d& origin_m() const { return origin_m_; }

  absl::StatusOr<Frame> Read(std::size_t index) {
    const std::int64_t number = static_cast<std::int64_t>(index);
    if (number < 0 || number >= meta_.frame_count) {
      return absl::OutOfRangeError(absl::StrCat("frame index ", index, "; ", path_.string(),
                                                " has ", meta_.frame_count, " frames"));
    }
    select_.BindInteger(1, number);
    absl::StatusOr<Frame> frame = ReadRow();
    select_.Reset();
    if (!frame.ok()) return At(path_, absl::StrCat(", frame ", number), frame.status());
    return frame;
  }

 private:
  absl::StatusOr<Frame> ReadRow() {
    const absl::StatusOr<bool> there = select_.Step();
    if (!there.ok()) return there.status();
    if (!*there) return absl::DataLossError("is missing");
    RowView row;
    row.number = select_.Integer(0);
    row.sensor_id = select_.Bytes(1);
    row.sequence = select_.Integer(2);
    row.stamp_ns = select_.Integer(3);
    row.point_count = select_.Integer(4);
    row.arrays = select_.Integer(5);
    row.world_from_sensor = select_.Bytes(6);
    row.motions = select_.Bytes(7);
    row.poses = select_.Bytes(8);
    row.points = select_.Bytes(9);
    if (ChecksumOf(row) != select_.Integer(10)) {
      return absl::DataLossError("damaged (its checksum does not fit)");
    }
    return DecodeFrame(row);
  }

  Path path_;
  SqliteDatabase database_;
  SqliteStatement select_;
  RecordedMeta meta_;
  Eigen::Vector3d origin_m_;
};

void AddFrame(const Frame& frame, RecordingInfo& info) {
  info.first_stamp = info.frames == 0 ? frame.stamp : std::min(info.first_stamp, frame.stamp);
  info.last_stamp = info.frames == 0 ? frame.stamp : std::max(info.last_stamp, frame.stamp);
  ++info.frames;
  info.points += static_cast<std::int64_t>(frame.points_S.size());
  ++info.sensors[frame.sensor_id];
  std::map<ObjectId, std::int64_t> points;
  for (ObjectId label : frame.labels) {
    if (label > kStaticLabel) ++points[label];
  }
  for (const auto& [id, count] : points) {
    ++info.objects[id].frames;
    info.objects[id].points += count;
  }
  for (const ObjectMotion& motion : frame.motions) ++info.objects[motion.id].motions;
  for (const ObjectPose& pose : frame.poses) ++info.objects[pose.id].motions;
}

}  // namespace

absl::StatusOr<FrameSource> OpenRecording(const Path& path) {
  const auto recording = Recording::Open(path);
  if (!recording.ok()) return recording.status();
  const RecordedMeta& meta = (*recording)->meta();
  FrameSource source;
  source.description = absl::StrCat("recording ", path.string(),
                                    meta.description.empty() ? "" : ": ", meta.description);
  source.frame_count = static_cast<std::size_t>(meta.frame_count);
  source.resolution_m = meta.resolution_m;
  source.origin_m = (*recording)->origin_m();
  source.read = [shared = *recording](std::size_t index) { return shared->Read(index); };
  return source;
}

absl::StatusOr<RecordingInfo> InspectRecording(const Path& path) {
  const auto recording = Recording::Open(path);
  if (!recording.ok()) return recording.status();
  const RecordedMeta& meta = (*recording)->meta();
  RecordingInfo info;
  info.description = meta.description;
  info.resolution_m = meta.resolution_m;
  info.origin_m = (*recording)->origin_m();
  for (std::int64_t i = 0; i < meta.frame_count; ++i) {
    const absl::StatusOr<Frame> frame = (*recording)->Read(static_cast<std::size_t>(i));
    if (!frame.ok()) return frame.status();
    AddFrame(*frame, info);
  }
  std::error_code ignored;
  info.file_bytes = std::filesystem::file_size(path, ignored);
  return info;
}

}  // namespace clearway
