#include "io/lidar_frames.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// A guess at the average: registered to a map, ten seconds of a KITTI drive are carried back by
// 1.9 m and a degree, and how large the error is said to be hardly matters to that.
constexpr double kGpsError_m = 1, kGpsError_rad = 0.02;

// Shared by the copies of a FrameSource.
struct OpenScans {
  std::shared_ptr<const LidarScans> scans;
  std::vector<RecordedPose> poses;  // of the range
  std::vector<RecordedBox> boxes;   // of the range, ascending (frame, id)
  std::set<Time> left_out_stamps;   // of frames that do not count
  // Those whose points turned out to be unreadable: no later motion starts there.
  mutable std::set<int> unreadable = {};
};

std::span<const RecordedBox> BoxesOf(const OpenScans& open, int frame) {
  // As two searches: clang 14 cannot compile equal_range of GCC 12's library.
  return {std::ranges::lower_bound(open.boxes, frame, {}, &RecordedBox::frame),
          std::ranges::upper_bound(open.boxes, frame, {}, &RecordedBox::frame)};
}

const RecordedBox* BoxOf(const OpenScans& open, std::size_t index, ObjectId id) {
  const int frame = open.poses[index].frame;
  if (open.unreadable.contains(frame)) return nullptr;
  const auto boxes = BoxesOf(open, frame);
  const auto box = std::ranges::lower_bound(boxes, id, {}, &RecordedBox::id);
  return box != boxes.end() && box->id == id ? &*box : nullptr;
}

// The frames of which one is the begin of an object's motion to the frame: that before it and, with
// options.motions_over, those of that time.
std::size_t FirstBegin(const OpenScans& open, std::size_t index) {
  const Time earliest = open.poses[index].stamp - open.scans->options.motions_over;
  std::size_t first = index - 1;
  while (first > 0 && open.poses[first - 1].stamp >= earliest) --first;
  return first;
}

// The frame at which the object's motion to the frame begins: the first one from `first` on that
// has a box of it, else, after a gap in its track, the last one before.
std::optional<std::size_t> BeginOf(const OpenScans& open, std::size_t first, std::size_t index,
                                   ObjectId id) {
  constexpr Duration kLongestGap = std::chrono::seconds(10);
  for (std::size_t from = first; from < index; ++from) {
    if (BoxOf(open, from, id) != nullptr) return from;
  }
  const Time earliest = open.poses[index].stamp - kLongestGap;
  for (std::size_t from = first; from-- > 0 && open.poses[from].stamp >= earliest;) {
    if (BoxOf(open, from, id) != nullptr) return from;
  }
  return std::nullopt;
}

bool HasMotionOf(ObjectId id, const Frame& frame) {
  return std::ranges::find(frame.motions, id, &ObjectMotion::id) != frame.motions.end();
}

// Eq. (2) for every object with a box at the frame and at one before. A box that has turned by
// about pi since then gives a motion of that turn: the scene leaves it out, and names it.
void AddMotions(const OpenScans& open, std::size_t index, Frame& frame) {
  if (index == 0) return;
  const std::size_t first = FirstBegin(open, index);
  for (const RecordedBox& box : BoxesOf(open, open.poses[index].frame)) {
    const std::optional<std::size_t> from = BeginOf(open, first, index, box.id);
    if (!from) continue;
    if (open.scans->has_motions &&
        (open.poses[*from].frame + 1 == open.poses[index].frame || HasMotionOf(box.id, frame))) {
      continue;
    }
    const Pose H_W = box.T_W_B * Inverse(BoxOf(open, *from, box.id)->T_W_B);
    frame.motions.push_back({box.id, H_W, open.poses[*from].stamp});
  }
}

absl::StatusOr<Frame> ReadFrame(const OpenScans& open, std::size_t index) {
  const LidarFolderOptions& options = open.scans->options;
  if (index >= open.poses.size()) {
    return absl::OutOfRangeError(absl::StrCat("frame index ", index, "; ", open.scans->name,
                                              " has ", open.poses.size(), " frames"));
  }
  const RecordedPose& pose = open.poses[index];
  const std::span<const RecordedBox> boxes = BoxesOf(open, pose.frame);
  Frame frame;
  frame.sensor_id = options.sensor_id;
  frame.sequence = static_cast<std::uint64_t>(pose.frame);
  frame.stamp = pose.stamp;
  frame.T_W_S = pose.T_W_S;
  const Path path = open.scans->points_of(pose.frame);
  std::error_code error;
  if (!options.allow_missing_points || std::filesystem::exists(path, error)) {
    const absl::Status status = open.scans->read(path, boxes, frame);
    if (!status.ok()) {
      open.unreadable.insert(pose.frame);
      return status;
    }
  }
  // Motions of the source itself may start there, too.
  std::erase_if(frame.motions, [&](const ObjectMotion& motion) {
    return open.left_out_stamps.contains(motion.from);
  });
  if (options.objects == LidarObjects::kMotions) AddMotions(open, index, frame);
  if (options.objects == LidarObjects::kPoses) {
    for (const RecordedBox& box : boxes) frame.poses.push_back({box.id, box.T_W_B});
  }
  return frame;
}

std::vector<std::pair<int, Path>> MissingPoints(const OpenScans& open) {
  std::vector<std::pair<int, Path>> missing;
  std::error_code error;
  for (const RecordedPose& pose : open.poses) {
    Path path = open.scans->points_of(pose.frame);
    if (!std::filesystem::is_regular_file(path, error)) {
      missing.emplace_back(pose.frame, std::move(path));
    }
  }
  return missing;
}

absl::Status NoPoints(const std::vector<std::pair<int, Path>>& missing, std::size_t frames) {
  std::error_code error;
  const Path& first = missing.front().second;
  const bool exists = std::filesystem::exists(first, error);
  return absl::NotFoundError(absl::StrCat(
      first.string(), exists ? ": is not a file; " : ": no such file; ", missing.size(), " of ",
      frames,
      " frames have a pose but no file of points (--allow-missing-points goes on without)"));
}

template <class Row>
std::vector<Row> Counted(const std::vector<Row>& rows, const LidarFolderOptions& options,
                         const RowsLeftOut& left_out) {
  std::vector<Row> result;
  for (const Row& row : rows) {
    const bool in_range = row.frame >= options.first_frame && row.frame <= options.last_frame;
    if (in_range && !left_out.Has(row)) result.push_back(row);
  }
  return result;
}

OpenScans Without(const RowsLeftOut& left_out, const std::shared_ptr<const LidarScans>& scans) {
  OpenScans open{scans,
                 Counted(scans->poses, scans->options, left_out),
                 Counted(scans->boxes, scans->options, left_out),
                 {}};
  for (const RecordedPose& pose : scans->poses) {
    if (left_out.Has(pose)) open.left_out_stamps.insert(pose.stamp);
  }
  return open;
}

FrameSource SourceOf(OpenScans scans) {
  const auto open = std::make_shared<const OpenScans>(std::move(scans));
  FrameSource source;
  source.frame_count = open->poses.size();
  source.read = [open](std::size_t index) { return ReadFrame(*open, index); };
  return source;
}

}  // namespace

const RecordedPose* PoseOf(const std::vector<RecordedPose>& poses, std::int64_t frame) {
  const auto found = std::ranges::lower_bound(poses, frame, {}, &RecordedPose::frame);
  return found != poses.end() && found->frame == frame ? &*found : nullptr;
}

absl::Status CheckFramePeriod(Duration period) {
  constexpr Duration kLongest = std::chrono::seconds(10);
  if (period > Duration::zero() && period <= kLongest) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("frame_period: is ", period.count(),
                                                 " ns; it must be above 0 and at most ",
                                                 kLongest.count(), " ns"));
}

absl::StatusOr<LidarFolder> FramesOf(LidarScans given) {
  const auto scans = std::make_shared<const LidarScans>(std::move(given));
  const LidarFolderOptions& options = scans->options;
  LidarFolder result;
  result.poses = scans->poses;
  result.boxes = scans->boxes;
  result.first_pose = static_cast<std::size_t>(
      std::ranges::lower_bound(result.poses, options.first_frame, {}, &RecordedPose::frame) -
      result.poses.begin());
  OpenScans open = Without({}, scans);
  if (open.poses.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(
        scans->name, ": no frame from ", options.first_frame, " to ", options.last_frame,
        "; the tables hold ", result.poses.front().frame, " to ", result.poses.back().frame));
  }
  result.missing_points = MissingPoints(open);
  if (!options.allow_missing_points && !result.missing_points.empty()) {
    return NoPoints(result.missing_points, open.poses.size());
  }
  result.frames = SourceOf(std::move(open));
  result.frames.description = scans->name;
  result.frames.left_out = scans->left_out;
  if (scans->of_gps) {
    result.frames.sensor_pose_error_m = kGpsError_m;
    result.frames.sensor_pose_error_rad = kGpsError_rad;
  }
  result.frames_without = [scans](const RowsLeftOut& left_out) {
    return SourceOf(Without(left_out, scans));
  };
  return result;
}

}  // namespace clearway
