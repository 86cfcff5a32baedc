// Recordings: frames in one SQLite file. The format is in docs/formats.md.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"

namespace clearway {

// The version of the format that is written, and the only one that is read.
inline constexpr int kRecordingVersion = 1;

struct RecordingOptions {
  std::string description;    // for people: what was recorded
  double resolution_m = 0.1;  // voxel size that suits the data; above 0
  // As FrameSource::origin_m; finite.
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  int compression_level = 3;  // zstd's, 1 to 19
  bool overwrite = false;     // replace an existing file; else it is an error
};

// Writes one recording. One thread at a time. The file appears under its name, whole, when Close
// succeeds; until then it is `<path>.partial`, which a writer that is destroyed unclosed removes.
class RecordingWriter {
 public:
  // ALREADY_EXISTS, INVALID_ARGUMENT for options out of range, UNAVAILABLE if it cannot be written.
  static absl::StatusOr<std::unique_ptr<RecordingWriter>> Create(
      const std::filesystem::path& path, const RecordingOptions& options = {});
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;

  // Adds a frame, as it is: any floating-point value comes back bit for bit. INVALID_ARGUMENT if
  // its arrays disagree in length, RESOURCE_EXHAUSTED above 20 million points; the recording then
  // goes on without the frame. After an error of the disk every further call returns that error.
  absl::Status Append(const Frame& frame);

  // Completes the recording and gives it its name. Nothing may be appended afterwards.
  absl::Status Close();

 private:
  struct Impl;
  explicit RecordingWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Opens a recording for reading only. Each frame is checked against its checksum when it is read.
// NOT_FOUND; INVALID_ARGUMENT for a file of another kind; FAILED_PRECONDITION for another version
// of the format; DATA_LOSS for one that is cut off or damaged, naming the frame and the field.
absl::StatusOr<FrameSource> OpenRecording(const std::filesystem::path& path);

// What a recording holds.
struct RecordingInfo {
  struct Object {
    std::int64_t frames = 0;  // with points of it
    std::int64_t points = 0;
    std::int64_t motions = 0;  // motions or poses
  };
  std::string description;
  double resolution_m = 0;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // as FrameSource's
  std::int64_t frames = 0;
  std::int64_t points = 0;
  Time first_stamp;  // the lowest and the highest; epoch if there is no frame
  Time last_stamp;
  std::map<std::string, std::int64_t> sensors;  // frames by sensor_id
  std::map<ObjectId, Object> objects;
  std::uint64_t file_bytes = 0;

  Duration duration() const { return last_stamp - first_stamp; }
};

// Lists a recording. Reads and so verifies every frame; fails as OpenRecording and its frames do.
absl::StatusOr<RecordingInfo> InspectRecording(const std::filesystem::path& path);

}  // namespace clearway
