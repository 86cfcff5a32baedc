#include "clearway/io/lidar_folder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "io/file.h"
#include "io/lidar_tables.h"

namespace clearway {
namespace {

static_assert(std::endian::native == std::endian::little, "points are stored little endian");

constexpr std::size_t kRecordBytes = 14;  // float32 x, y, z, int16 label
constexpr std::uint64_t kMaxPointBytes = kRecordBytes * 20'000'000;

using Path = std::filesystem::path;

// What reading one frame needs; shared by the copies of a FrameSource.
struct OpenFolder {
  Path folder;
  LidarFolderOptions options;
  std::vector<RecordedPose> poses;  // of the range
  std::vector<RecordedBox> boxes;   // of the range, ascending (frame, id)
};

Path PointsPath(const Path& folder, int frame) {
  return folder / "points" / absl::StrFormat("%04d.bin", frame);
}

absl::Status ReadPoints(const Path& path, Frame& frame) {
  const absl::StatusOr<std::string> bytes = ReadWholeFile(path, kMaxPointBytes);
  if (!bytes.ok()) return bytes.status();
  if (bytes->size() % kRecordBytes != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat(path.string(), ": ", bytes->size(), " bytes are not a whole number of ",
                     kRecordBytes, "-byte points; the file seems cut off"));
  }
  const std::size_t count = bytes->size() / kRecordBytes;
  frame.points_S.resize(count);
  frame.labels.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* const record = bytes->data() + i * kRecordBytes;
    std::int16_t label;
    std::memcpy(frame.points_S[i].data(), record, 12);
    std::memcpy(&label, record + 12, 2);
    if (label < kIgnoreLabel) {
      return absl::InvalidArgumentError(absl::StrCat(path.string(), ", point ", i, " at byte ",
                                                     i * kRecordBytes + 12, ": label ", label,
                                                     "; the lowest is ", kIgnoreLabel));
    }
    frame.labels[i] = label;
  }
  return absl::OkStatus();
}

std::pair<const RecordedBox*, const RecordedBox*> BoxesOf(const std::vector<RecordedBox>& boxes,
                                                          int frame) {
  const auto first = std::partition_point(boxes.begin(), boxes.end(),
                                          [&](const auto& box) { return box.frame < frame; });
  const auto last =
      std::partition_point(first, boxes.end(), [&](const auto& box) { return box.frame == frame; });
  return {boxes.data() + (first - boxes.begin()), boxes.data() + (last - boxes.begin())};
}

const RecordedBox* BoxOf(const OpenFolder& open, std::size_t index, ObjectId id) {
  const auto [begin, end] = BoxesOf(open.boxes, open.poses[index].frame);
  const RecordedBox* const box = std::ranges::lower_bound(begin, end, id, {}, &RecordedBox::id);
  return box != end && box->id == id ? box : nullptr;
}

// Eq. (2) for every object with a box at the frame and at one that is the motion's begin.
void AddMotions(const OpenFolder& open, std::size_t index, Frame& frame) {
  if (index == 0) return;
  const Time earliest = open.poses[index].stamp - open.options.motions_over;
  std::size_t first = index - 1;
  while (first > 0 && open.poses[first - 1].stamp >= earliest) --first;
  const auto [begin, end] = BoxesOf(open.boxes, open.poses[index].frame);
  for (const RecordedBox* box = begin; box != end; ++box) {
    for (std::size_t from = first; from < index; ++from) {
      const RecordedBox* const then = BoxOf(open, from, box->id);
      if (then == nullptr) continue;
      frame.motions.push_back({box->id, box->T_W_B * Inverse(then->T_W_B), open.poses[from].stamp});
      break;
    }
  }
}

absl::StatusOr<Frame> ReadFrame(const OpenFolder& open, std::size_t index) {
  if (index >= open.poses.size()) {
    return absl::OutOfRangeError(absl::StrCat("frame index ", index, "; ", open.folder.string(),
                                              " has ", open.poses.size(), " frames"));
  }
  const RecordedPose& pose = open.poses[index];
  Frame frame;
  frame.sensor_id = open.options.sensor_id;
  frame.sequence = static_cast<std::uint64_t>(pose.frame);
  frame.stamp = pose.stamp;
  frame.T_W_S = pose.T_W_S;
  const Path path = PointsPath(open.folder, pose.frame);
  std::error_code error;
  if (!open.options.allow_missing_points || std::filesystem::exists(path, error)) {
    const absl::Status status = ReadPoints(path, frame);
    if (!status.ok()) return status;
  }
  if (open.options.objects == LidarObjects::kMotions) AddMotions(open, index, frame);
  if (open.options.objects == LidarObjects::kPoses) {
    const auto [begin, end] = BoxesOf(open.boxes, pose.frame);
    for (const RecordedBox* box = begin; box != end; ++box) {
      frame.poses.push_back({box->id, box->T_W_B});
    }
  }
  return frame;
}

// The part of the tables' names that tells the pairs apart.
absl::StatusOr<std::string> TableSuffix(const Path& folder, LidarPoses poses) {
  constexpr std::pair<LidarPoses, const char*> kPairs[] = {
      {LidarPoses::kPlain, ""}, {LidarPoses::kIcp, "_icp"}, {LidarPoses::kOxts, "_oxts"}};
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    return absl::NotFoundError(absl::StrCat(folder.string(), ": no such folder"));
  }
  for (const auto& [kind, suffix] : kPairs) {
    if (poses == kind) return suffix;
    if (poses == LidarPoses::kAny &&
        std::filesystem::exists(folder / absl::StrCat("poses", suffix, ".csv"), error)) {
      return suffix;
    }
  }
  return absl::NotFoundError(
      absl::StrCat(folder.string(), ": none of poses.csv, poses_icp.csv, poses_oxts.csv is there"));
}

absl::Status CheckPointFiles(const OpenFolder& open) {
  std::size_t missing = 0;
  Path first;
  for (const RecordedPose& pose : open.poses) {
    const Path path = PointsPath(open.folder, pose.frame);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) continue;
    if (missing++ == 0) first = path;
  }
  if (missing == 0) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat(first.string(), ": no such file; ", missing, " of ",
                                          open.poses.size(),
                                          " frames have a pose but no file of points"));
}

template <class Row>
std::vector<Row> InRange(const std::vector<Row>& rows, const LidarFolderOptions& options) {
  std::vector<Row> result;
  for (const Row& row : rows) {
    if (row.frame >= options.first_frame && row.frame <= options.last_frame) result.push_back(row);
  }
  return result;
}

}  // namespace

absl::StatusOr<LidarFolder> OpenLidarFolder(const Path& folder, const LidarFolderOptions& options) {
  const absl::StatusOr<std::string> suffix = TableSuffix(folder, options.poses);
  if (!suffix.ok()) return suffix.status();
  const auto poses = ReadLidarPoses(folder / absl::StrCat("poses", *suffix, ".csv"));
  if (!poses.ok()) return poses.status();
  const auto boxes = ReadLidarBoxes(folder / absl::StrCat("objects", *suffix, ".csv"), *poses);
  if (!boxes.ok()) return boxes.status();

  const auto open = std::make_shared<const OpenFolder>(
      OpenFolder{folder, options, InRange(*poses, options), InRange(*boxes, options)});
  if (open->poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder.string(), ": no frame from ", options.first_frame, " to ", options.last_frame,
        "; the tables hold ", poses->front().frame, " to ", poses->back().frame));
  }
  if (!options.allow_missing_points) {
    const absl::Status status = CheckPointFiles(*open);
    if (!status.ok()) return status;
  }
  LidarFolder result;
  result.frames = {absl::StrCat("LiDAR folder ", folder.string()), open->poses.size(), 0.1,
                   [open](std::size_t index) { return ReadFrame(*open, index); }};
  result.poses = *poses;
  result.boxes = *boxes;
  return result;
}

}  // namespace clearway
