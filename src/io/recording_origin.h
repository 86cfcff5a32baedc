// The origin that a recording's world was moved to, in a table of its own.
#pragma once

#include <Eigen/Core>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "io/sqlite.h"

namespace clearway {

// Readers from before there were origins ignore the table, so it does not make another version.
absl::Status WriteRecordedOrigin(const Eigen::Vector3d& origin_m, SqliteDatabase& database);

// Zero if there is none. DATA_LOSS if it is damaged, or for a table that no recording has.
absl::StatusOr<Eigen::Vector3d> ReadRecordedOrigin(SqliteDatabase& database);

}  // namespace clearway
