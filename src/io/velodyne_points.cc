#include "io/velodyne_points.h"

#include <bit>
#include <cstring>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"

namespace clearway {

static_assert(std::endian::native == std::endian::little, "points are stored little endian");

absl::Status ReadVelodynePoints(const std::filesystem::path& path, Frame& frame) {
  constexpr std::size_t kRecordBytes = 16;  // float32 x, y, z, reflectance
  constexpr std::uint64_t kMaxPointBytes = kRecordBytes * 20'000'000;
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxPointBytes);
  if (!bytes.ok()) return bytes.status();
  if (bytes->size() % kRecordBytes != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": ", bytes->size(), " bytes are not a whole number of ",
                     kRecordBytes, "-byte points; the file seems cut off"));
  }
  frame.points_S.resize(bytes->size() / kRecordBytes);
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    std::memcpy(frame.points_S[i].data(), bytes->data() + i * kRecordBytes, 12);
  }
  return absl::OkStatus();
}

}  // namespace clearway
