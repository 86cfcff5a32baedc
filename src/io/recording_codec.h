// A frame as the row of a recording, byte by byte as in docs/formats.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "clearway/scene/frame.h"

namespace clearway {

inline constexpr std::size_t kMaxRecordedPoints = 20'000'000;
inline constexpr std::size_t kMaxRecordedParts = 100'000;

// The columns of one row of the table `frame`, but for the checksum. Views into a row that is read
// are valid as long as that row is current.
template <class Text>
struct RecordedRow {
  std::int64_t number = 0;
  Text sensor_id;
  std::int64_t sequence = 0;  // two's complement
  std::int64_t stamp_ns = 0;
  std::int64_t point_count = 0;
  // Bit 0: no_return is there, bit 1: origins, bit 2: parts, bit 3: sensor_run.
  std::int64_t arrays = 0;
  Text world_from_sensor;
  Text motions;
  Text poses;
  Text points;  // zstd
};
using EncodedRow = RecordedRow<std::string>;
using RowView = RecordedRow<std::string_view>;

RowView ViewOf(const EncodedRow& row);

// XXH3 of every column.
std::int64_t ChecksumOf(const RowView& row);

// INVALID_ARGUMENT if the frame's arrays disagree in length; RESOURCE_EXHAUSTED for too many
// points.
absl::StatusOr<EncodedRow> EncodeFrame(const Frame& frame, std::int64_t number,
                                       int compression_level);

// DATA_LOSS naming the column, if the row is not what EncodeFrame makes.
absl::StatusOr<Frame> DecodeFrame(const RowView& row);

}  // namespace clearway
