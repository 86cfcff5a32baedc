#include "io/recording_origin.h"

#include <xxhash.h>

#include <bit>
#include <cstdint>
#include <string>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

std::int64_t ChecksumOf(const Eigen::Vector3d& origin_m) {
  return std::bit_cast<std::int64_t>(XXH3_64bits(origin_m.data(), 3 * sizeof(double)));
}

// A damaged name would hide the table.
absl::Status CheckTables(SqliteDatabase& database) {
  auto others = database.Prepare(
      "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%' "
      "AND name NOT IN ('meta', 'frame', 'origin')");
  if (!others.ok()) return others.status();
  const absl::StatusOr<bool> found = others->Step();
  if (!found.ok()) return found.status();
  if (!*found) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrCat("unknown table '", std::string(others->Bytes(0)), "'; damaged?"));
}

}  // namespace

absl::Status WriteRecordedOrigin(const Eigen::Vector3d& origin_m, SqliteDatabase& database) {
  const absl::Status created = database.Execute(
      "CREATE TABLE origin (x_m REAL NOT NULL, y_m REAL NOT NULL, z_m REAL NOT NULL, "
      "checksum INTEGER NOT NULL) STRICT");
  if (!created.ok()) return created;
  auto insert = database.Prepare("INSERT INTO origin VALUES (?, ?, ?, ?)");
  if (!insert.ok()) return insert.status();
  for (int i = 0; i < 3; ++i) insert->BindReal(1 + i, origin_m[i]);
  insert->BindInteger(4, ChecksumOf(origin_m));
  return insert->Step().status();
}

absl::StatusOr<Eigen::Vector3d> ReadRecordedOrigin(SqliteDatabase& database) {
  if (auto status = CheckTables(database); !status.ok()) return status;
  const auto tables = database.QueryInteger(
      "SELECT COUNT(*) FROM sqlite_schema WHERE type = 'table' AND name = 'origin'");
  if (!tables.ok()) return tables.status();
  if (*tables == 0) return Eigen::Vector3d::Zero();
  auto select = database.Prepare("SELECT x_m, y_m, z_m, checksum FROM origin");
  if (!select.ok()) return select.status();
  const absl::StatusOr<bool> row = select->Step();
  if (!row.ok()) return row.status();
  if (!*row) return absl::DataLossError("origin: no row");
  const Eigen::Vector3d origin_m(select->Real(0), select->Real(1), select->Real(2));
  if (!origin_m.allFinite() || ChecksumOf(origin_m) != select->Integer(3)) {
    return absl::DataLossError("origin: damaged (its checksum does not fit)");
  }
  return origin_m;
}

}  // namespace clearway
