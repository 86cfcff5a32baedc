// Rows of a recording, past their checksum, which a damaged file would not pass. The files of an
// input (FilesOf) are the columns; those that hold integers are text.
#include <charconv>

#include "fuzz/fuzz.h"
#include "io/recording_codec.h"

namespace clearway::fuzz {
namespace {

std::int64_t IntegerOf(std::string_view text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

RowView RowOf(const std::vector<InputFile>& columns) {
  RowView row;
  for (const auto& [name, bytes] : columns) {
    if (name == "number") row.number = IntegerOf(bytes);
    if (name == "sensor_id") row.sensor_id = bytes;
    if (name == "sequence") row.sequence = IntegerOf(bytes);
    if (name == "stamp_ns") row.stamp_ns = IntegerOf(bytes);
    if (name == "point_count") row.point_count = IntegerOf(bytes);
    if (name == "arrays") row.arrays = IntegerOf(bytes);
    if (name == "world_from_sensor") row.world_from_sensor = bytes;
    if (name == "motions") row.motions = bytes;
    if (name == "poses") row.poses = bytes;
    if (name == "points") row.points = bytes;
  }
  return row;
}

void Run(std::string_view input) {
  const auto frame = DecodeFrame(RowOf(FilesOf(input)));
  RequireForeseen(frame.status());
  if (!frame.ok()) return;
  const auto row = EncodeFrame(*frame, 0, 1);
  Require(row.ok(), "a frame that was read cannot be written: " + row.status().ToString());
  const auto again = DecodeFrame(ViewOf(*row));
  Require(again.ok() && again->labels == frame->labels, "what was written is read otherwise");
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
