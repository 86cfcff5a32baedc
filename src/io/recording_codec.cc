#include "io/recording_codec.h"

#include <xxhash.h>
#include <zstd.h>

#include <bit>
#include <cstring>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "recordings are little endian");

constexpr std::int64_t kHasNoReturn = 1;
constexpr std::int64_t kHasOrigins = 2;
constexpr std::int64_t kHasParts = 4;
constexpr std::int64_t kHasRun = 8;
constexpr std::size_t kPartBytes = 8;  // id, whole
constexpr std::size_t kRunBytes = 8;
constexpr std::size_t kPoseBytes = 56;                 // 7 doubles
constexpr std::size_t kMotionBytes = 12 + kPoseBytes;  // id, from
constexpr std::size_t kObjectPoseBytes = 4 + kPoseBytes;

template <class T>
void Put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void PutPose(std::string& out, const Pose& pose) {
  for (int i = 0; i < 4; ++i) Put(out, pose.rotation.coeffs()[i]);  // x, y, z, w
  for (int i = 0; i < 3; ++i) Put(out, pose.translation[i]);
}

// One coordinate after the other: similar numbers side by side compress better.
void PutVectors(std::string& out, const std::vector<Eigen::Vector3f>& vectors) {
  for (int i = 0; i < 3; ++i) {
    for (const Eigen::Vector3f& v : vectors) Put(out, v[i]);
  }
}

// Takes values off the front of bytes that are known to be long enough.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : at_(bytes.data()) {}

  template <class T>
  T Take() {
    T value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

  Pose TakePose() {
    Pose pose;
    for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = Take<double>();
    for (int i = 0; i < 3; ++i) pose.translation[i] = Take<double>();
    return pose;
  }

  std::vector<Eigen::Vector3f> TakeVectors(std::size_t count) {
    std::vector<Eigen::Vector3f> vectors(count);
    for (int i = 0; i < 3; ++i) {
      for (Eigen::Vector3f& v : vectors) v[i] = Take<float>();
    }
    return vectors;
  }

  template <class T>
  std::vector<T> TakeArray(std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }

 private:
  const char* at_;
};

std::size_t BytesOfPoints(std::size_t count, std::int64_t arrays) {
  return count * (16 + (arrays & kHasNoReturn ? 1 : 0) + (arrays & kHasOrigins ? 12 : 0)) +
         (arrays & kHasRun ? kRunBytes : 0);
}

absl::Status CheckLength(const char* field, std::size_t size, std::size_t points) {
  if (size == points) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, " holds ", size, " values for ", points, " points"));
}

absl::Status CheckFrame(const Frame& frame) {
  const std::size_t count = frame.points_S.size();
  if (count > kMaxRecordedPoints) {
    return absl::ResourceExhaustedError(
        absl::StrCat("points: ", count, " points; the limit is ", kMaxRecordedPoints));
  }
  if (frame.parts.size() > kMaxRecordedParts) {
    return absl::ResourceExhaustedError(
        absl::StrCat("parts: ", frame.parts.size(), " parts; the limit is ", kMaxRecordedParts));
  }
  absl::Status status = CheckLength("labels", frame.labels.size(), count);
  if (status.ok() && !frame.no_return.empty()) {
    status = CheckLength("no_return", frame.no_return.size(), count);
  }
  if (status.ok() && !frame.origins_S.empty()) {
    status = CheckLength("origins", frame.origins_S.size(), count);
  }
  return status;
}

absl::StatusOr<std::string> Compressed(const std::string& bytes, int level) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size)) {
    return absl::InternalError(absl::StrCat("points: zstd: ", ZSTD_getErrorName(size)));
  }
  out.resize(size);
  return out;
}

// Of `least` bytes, and if there are parts, of some more. What is taken is bounded by
// kMaxRecordedPoints and kMaxRecordedParts, whatever the compressed bytes claim.
absl::StatusOr<std::string> Decompressed(std::string_view bytes, std::size_t least,
                                         bool has_parts) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  const std::size_t most = least + (has_parts ? kMaxRecordedParts * kPartBytes : 0);
  if (size < least || size > most || (size - least) % kPartBytes != 0) {
    return absl::DataLossError(absl::StrCat("points: not ", least,
                                            has_parts ? " bytes and those of parts" : " bytes",
                                            " compressed by zstd"));
  }
  std::string out(size, '\0');
  const std::size_t result = ZSTD_decompress(out.data(), size, bytes.data(), bytes.size());
  if (ZSTD_isError(result)) {
    return absl::DataLossError(absl::StrCat("points: zstd: ", ZSTD_getErrorName(result)));
  }
  if (result != size) return absl::DataLossError("points: zstd stopped early");
  return out;
}

absl::Status CheckMultiple(const char* column, std::string_view bytes, std::size_t record) {
  if (bytes.size() % record == 0) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrCat(column, ": ", bytes.size(), " bytes are not a multiple of ", record));
}

absl::Status CheckRow(const RowView& row) {
  if (row.point_count < 0 || row.point_count > static_cast<std::int64_t>(kMaxRecordedPoints)) {
    return absl::DataLossError(absl::StrCat("point_count: ", row.point_count,
                                            "; it must lie between 0 and ", kMaxRecordedPoints));
  }
  if ((row.arrays & ~(kHasNoReturn | kHasOrigins | kHasParts | kHasRun)) != 0) {
    return absl::DataLossError(absl::StrCat("arrays: unknown bits in ", row.arrays));
  }
  if (row.world_from_sensor.size() != kPoseBytes) {
    return absl::DataLossError(absl::StrCat("world_from_sensor: ", row.world_from_sensor.size(),
                                            " bytes instead of ", kPoseBytes));
  }
  const absl::Status motions = CheckMultiple("motions", row.motions, kMotionBytes);
  return motions.ok() ? CheckMultiple("poses", row.poses, kObjectPoseBytes) : motions;
}

void HashInteger(XXH3_state_t* state, std::int64_t value) {
  XXH3_64bits_update(state, &value, sizeof value);
}

void HashBytes(XXH3_state_t* state, std::string_view bytes) {
  HashInteger(state, static_cast<std::int64_t>(bytes.size()));
  XXH3_64bits_update(state, bytes.data(), bytes.size());
}

}  // namespace

RowView ViewOf(const EncodedRow& row) {
  return {row.number, row.sensor_id,         row.sequence, row.stamp_ns, row.point_count,
          row.arrays, row.world_from_sensor, row.motions,  row.poses,    row.points};
}

std::int64_t ChecksumOf(const RowView& row) {
  XXH3_state_t* const state = XXH3_createState();
  XXH3_64bits_reset(state);
  for (std::int64_t value : {row.number, row.sequence, row.stamp_ns, row.point_count, row.arrays}) {
    HashInteger(state, value);
  }
  for (std::string_view bytes :
       {row.sensor_id, row.world_from_sensor, row.motions, row.poses, row.points}) {
    HashBytes(state, bytes);
  }
  const std::uint64_t hash = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return std::bit_cast<std::int64_t>(hash);
}

absl::StatusOr<EncodedRow> EncodeFrame(const Frame& frame, std::int64_t number,
                                       int compression_level) {
  const absl::Status status = CheckFrame(frame);
  if (!status.ok()) return status;
  EncodedRow row;
  row.number = number;
  row.sensor_id = frame.sensor_id;
  row.sequence = std::bit_cast<std::int64_t>(frame.sequence);
  row.stamp_ns = ToNanoseconds(frame.stamp);
  row.point_count = static_cast<std::int64_t>(frame.points_S.size());
  row.arrays = (frame.no_return.empty() ? 0 : kHasNoReturn) |
               (frame.origins_S.empty() ? 0 : kHasOrigins) | (frame.parts.empty() ? 0 : kHasParts) |
               (frame.sensor_run == 0 ? 0 : kHasRun);
  PutPose(row.world_from_sensor, frame.T_W_S);
  for (const ObjectMotion& motion : frame.motions) {
    Put(row.motions, motion.id);
    Put(row.motions, ToNanoseconds(motion.from));
    PutPose(row.motions, motion.H_W);
  }
  for (const ObjectPose& pose : frame.poses) {
    Put(row.poses, pose.id);
    PutPose(row.poses, pose.T_W_B);
  }
  std::string points;
  points.reserve(BytesOfPoints(frame.points_S.size(), row.arrays));
  PutVectors(points, frame.points_S);
  for (ObjectId label : frame.labels) Put(points, label);
  for (std::uint8_t flag : frame.no_return) Put(points, flag);
  PutVectors(points, frame.origins_S);
  if (row.arrays & kHasRun) Put(points, frame.sensor_run);
  for (const ObjectPart& part : frame.parts) {
    Put(points, part.id);
    Put(points, part.whole);
  }
  absl::StatusOr<std::string> compressed = Compressed(points, compression_level);
  if (!compressed.ok()) return compressed.status();
  row.points = *std::move(compressed);
  return row;
}

absl::StatusOr<Frame> DecodeFrame(const RowView& row) {
  const absl::Status status = CheckRow(row);
  if (!status.ok()) return status;
  const std::size_t count = static_cast<std::size_t>(row.point_count);
  const std::size_t bytes_of_points = BytesOfPoints(count, row.arrays);
  const absl::StatusOr<std::string> points =
      Decompressed(row.points, bytes_of_points, (row.arrays & kHasParts) != 0);
  if (!points.ok()) return points.status();

  Frame frame;
  frame.sensor_id = std::string(row.sensor_id);
  frame.sequence = std::bit_cast<std::uint64_t>(row.sequence);
  frame.stamp = TimeFromNanoseconds(row.stamp_ns);
  frame.T_W_S = Reader(row.world_from_sensor).TakePose();
  Reader motions(row.motions);
  for (std::size_t i = 0; i < row.motions.size() / kMotionBytes; ++i) {
    const ObjectId id = motions.Take<ObjectId>();
    const Time from = TimeFromNanoseconds(motions.Take<std::int64_t>());
    frame.motions.push_back({id, motions.TakePose(), from});
  }
  Reader poses(row.poses);
  for (std::size_t i = 0; i < row.poses.size() / kObjectPoseBytes; ++i) {
    const ObjectId id = poses.Take<ObjectId>();
    frame.poses.push_back({id, poses.TakePose()});
  }
  Reader cloud(*points);
  frame.points_S = cloud.TakeVectors(count);
  frame.labels = cloud.TakeArray<ObjectId>(count);
  if (row.arrays & kHasNoReturn) frame.no_return = cloud.TakeArray<std::uint8_t>(count);
  if (row.arrays & kHasOrigins) frame.origins_S = cloud.TakeVectors(count);
  if (row.arrays & kHasRun) frame.sensor_run = cloud.Take<std::uint64_t>();
  for (std::size_t i = 0; i < (points->size() - bytes_of_points) / kPartBytes; ++i) {
    const ObjectId id = cloud.Take<ObjectId>();
    frame.parts.push_back({id, cloud.Take<ObjectId>()});
  }
  return frame;
}

}  // namespace clearway
