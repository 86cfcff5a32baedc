// The tables of a recording and what marks a file as one; docs/formats.md describes them.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace clearway {

inline constexpr std::int64_t kRecordingApplicationId = 0x434C5759;  // "CLWY"

inline constexpr char kCreateRecordingTables[] = R"(
CREATE TABLE meta (
  description TEXT NOT NULL, resolution_m REAL NOT NULL, frame_count INTEGER NOT NULL,
  checksum INTEGER NOT NULL) STRICT;
CREATE TABLE frame (
  number INTEGER PRIMARY KEY, sensor_id TEXT NOT NULL, sequence INTEGER NOT NULL,
  stamp_ns INTEGER NOT NULL, point_count INTEGER NOT NULL, arrays INTEGER NOT NULL,
  world_from_sensor BLOB NOT NULL, motions BLOB NOT NULL, poses BLOB NOT NULL,
  points BLOB NOT NULL, checksum INTEGER NOT NULL) STRICT;
)";

// The one row of `meta`, but for its checksum.
struct RecordedMeta {
  std::string description;
  double resolution_m = 0;
  std::int64_t frame_count = 0;
};

// XXH3 of the row.
std::int64_t ChecksumOf(const RecordedMeta& meta);

}  // namespace clearway
