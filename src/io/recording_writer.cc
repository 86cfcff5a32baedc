#include <xxhash.h>

#include <cmath>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/io/recording.h"
#include "io/recording_codec.h"
#include "io/recording_origin.h"
#include "io/recording_schema.h"
#include "io/sqlite.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// What a crash can lose at most.
constexpr std::int64_t kFramesPerTransaction = 32;

absl::Status WithName(const Path& path, const absl::Status& status) {
  if (status.ok()) return status;
  return absl::Status(status.code(),
                      absl::StrCat(path.string(), ": ", std::string(status.message())));
}

absl::Status CheckOptions(const RecordingOptions& options) {
  if (!(options.resolution_m > 0) || !std::isfinite(options.resolution_m)) {
    return absl::InvalidArgumentError(
        absl::StrCat("resolution_m is ", NumberText(options.resolution_m), "; it must be above 0"));
  }
  if (!options.origin_m.allFinite()) return absl::InvalidArgumentError("origin_m is not finite");
  if (options.compression_level < 1 || options.compression_level > 19) {
    return absl::InvalidArgumentError(absl::StrCat(
        "compression_level is ", options.compression_level, "; it must lie between 1 and 19"));
  }
  return absl::OkStatus();
}

// A stale rollback journal would be played back into the new file.
void RemoveWithJournal(const Path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  std::filesystem::remove(path.string() + "-journal", ignored);
}

}  // namespace

std::int64_t ChecksumOf(const RecordedMeta& meta) {
  std::string bytes = meta.description;
  bytes.append(reinterpret_cast<const char*>(&meta.resolution_m), sizeof meta.resolution_m);
  bytes.append(reinterpret_cast<const char*>(&meta.frame_count), sizeof meta.frame_count);
  return std::bit_cast<std::int64_t>(XXH3_64bits(bytes.data(), bytes.size()));
}

struct RecordingWriter::Impl {
  Path path;
  Path partial;
  RecordingOptions options;
  std::unique_ptr<SqliteDatabase> database;  // null once closed
  std::unique_ptr<SqliteStatement> insert;
  std::int64_t frames = 0;
  absl::Status broken;  // the first error of the disk

  absl::Status Start() {
    RemoveWithJournal(partial);
    absl::StatusOr<SqliteDatabase> opened =
        SqliteDatabase::Open(partial, SqliteDatabase::Mode::kCreate);
    if (!opened.ok()) return opened.status();
    database = std::make_unique<SqliteDatabase>(*std::move(opened));
    absl::Status status = database->Execute(
        absl::StrCat("PRAGMA application_id = ", kRecordingApplicationId,
                     "; PRAGMA user_version = ", kRecordingVersion, "; BEGIN;",
                     kCreateRecordingTables, "INSERT INTO meta VALUES ('', 0.0, 0, 0);"));
    if (!status.ok()) return status;
    if (!options.origin_m.isZero(0)) {
      status = WriteRecordedOrigin(options.origin_m, *database);
      if (!status.ok()) return status;
    }
    absl::StatusOr<SqliteStatement> statement =
        database->Prepare("INSERT INTO frame VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
    if (!statement.ok()) return statement.status();
    insert = std::make_unique<SqliteStatement>(*std::move(statement));
    return absl::OkStatus();
  }

  absl::Status Insert(const EncodedRow& row) {
    insert->BindInteger(1, row.number);
    insert->BindText(2, row.sensor_id);
    insert->BindInteger(3, row.sequence);
    insert->BindInteger(4, row.stamp_ns);
    insert->BindInteger(5, row.point_count);
    insert->BindInteger(6, row.arrays);
    insert->BindBlob(7, row.world_from_sensor);
    insert->BindBlob(8, row.motions);
    insert->BindBlob(9, row.poses);
    insert->BindBlob(10, row.points);
    insert->BindInteger(11, ChecksumOf(ViewOf(row)));
    const absl::StatusOr<bool> done = insert->Step();
    insert->Reset();
    return done.status();
  }

  // Ends the transaction with a count that fits the frames in it.
  absl::Status Commit() {
    const RecordedMeta meta{options.description, options.resolution_m, frames};
    absl::StatusOr<SqliteStatement> update = database->Prepare(
        "UPDATE meta SET description = ?, resolution_m = ?, frame_count = ?, checksum = ?");
    if (!update.ok()) return update.status();
    update->BindText(1, meta.description);
    update->BindReal(2, meta.resolution_m);
    update->BindInteger(3, meta.frame_count);
    update->BindInteger(4, ChecksumOf(meta));
    const absl::StatusOr<bool> done = update->Step();
    if (!done.ok()) return done.status();
    update->Reset();
    return database->Execute("COMMIT");
  }

  absl::Status Keep(const absl::Status& status) {
    if (!status.ok() && broken.ok()) broken = WithName(path, status);
    return broken;
  }
};

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RecordingWriter::~RecordingWriter() {
  if (impl_->database == nullptr) return;
  impl_->insert.reset();
  impl_->database.reset();
  RemoveWithJournal(impl_->partial);
}

absl::StatusOr<std::unique_ptr<RecordingWriter>> RecordingWriter::Create(
    const Path& path, const RecordingOptions& options) {
  absl::Status status = CheckOptions(options);
  if (!status.ok()) return status;
  const absl::StatusOr<Path> file = OutputFile(path);
  if (!file.ok()) return file.status();
  std::error_code error;
  if (!options.overwrite && std::filesystem::exists(*file, error)) {
    return absl::AlreadyExistsError(absl::StrCat(path.string(), ": is there already"));
  }
  auto impl = std::make_unique<Impl>();
  impl->path = *file;
  impl->partial = file->string() + ".partial";
  impl->options = options;
  status = impl->Start();
  std::unique_ptr<RecordingWriter> writer(new RecordingWriter(std::move(impl)));
  if (!status.ok()) return WithName(path, status);
  return writer;
}

absl::Status RecordingWriter::Append(const Frame& frame) {
  Impl& impl = *impl_;
  if (!impl.broken.ok()) return impl.broken;
  if (impl.database == nullptr) {
    return absl::FailedPreconditionError(absl::StrCat(impl.path.string(), ": closed already"));
  }
  const absl::StatusOr<EncodedRow> row =
      EncodeFrame(frame, impl.frames, impl.options.compression_level);
  if (!row.ok()) return WithName(impl.path, row.status());
  absl::Status status = impl.Insert(*row);
  if (!status.ok()) return impl.Keep(status);
  if (++impl.frames % kFramesPerTransaction != 0) return absl::OkStatus();
  status = impl.Commit();
  return impl.Keep(status.ok() ? impl.database->Execute("BEGIN") : status);
}

absl::Status RecordingWriter::Close() {
  Impl& impl = *impl_;
  if (!impl.broken.ok()) return impl.broken;
  if (impl.database == nullptr) return absl::OkStatus();
  const absl::Status status = impl.Commit();
  if (!status.ok()) return impl.Keep(status);
  impl.insert.reset();
  impl.database.reset();
  impl.broken = MoveInto(impl.partial, impl.path);
  return impl.broken;
}

}  // namespace clearway
