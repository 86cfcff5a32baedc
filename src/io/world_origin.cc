#include "clearway/io/world_origin.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

std::string Shortest(double number) {
  // Without an exponent, as coordinates are written, where that is not long.
  const double size = std::abs(number);
  const bool plain = size == 0 || (size >= 1e-6 && size < 1e12);
  std::array<char, 64> text;
  const auto format = plain ? std::chars_format::fixed : std::chars_format::general;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number, format).ptr;
  return {text.data(), end};
}

// The same motion of a world whose origin is elsewhere: p -> R (p + origin) + t - origin.
Pose MotionAt(const Pose& H_W, const Eigen::Vector3d& origin_m) {
  return {H_W.rotation, H_W.translation + (H_W.rotation * origin_m - origin_m)};
}

void Move(const Eigen::Vector3d& origin_m, Frame& frame) {
  frame.T_W_S.translation -= origin_m;
  for (ObjectPose& pose : frame.poses) pose.T_W_B.translation -= origin_m;
  for (ObjectMotion& motion : frame.motions) motion.H_W = MotionAt(motion.H_W, origin_m);
}

FrameSource Moved(FrameSource source, const Eigen::Vector3d& origin_m) {
  source.origin_m += origin_m;
  absl::StrAppend(&source.description, "; origin ", OriginText(source.origin_m), " subtracted");
  source.read = [read = std::move(source.read),
                 origin_m](std::size_t index) -> absl::StatusOr<Frame> {
    absl::StatusOr<Frame> frame = read(index);
    if (frame.ok()) Move(origin_m, *frame);
    return frame;
  };
  return source;
}

bool IsFar(const Pose& T_W_S) {
  const double limit_m = FrameLimits().max_coordinate_m;
  return !(T_W_S.translation.cwiseAbs().maxCoeff() <= limit_m);
}

// `asked`: whether an origin was given, which may be zero.
absl::Status TooFar(const FrameSource& source, const Pose& T_W_S, bool asked) {
  const bool moved = asked || !source.origin_m.isZero();
  return absl::InvalidArgumentError(absl::StrCat(
      source.description, ": the sensor is at ", OriginText(T_W_S.translation),
      moved ? " from there" : "", ", beyond the limit of ",
      Shortest(FrameLimits().max_coordinate_m), " m from the origin of the world; --origin ",
      moved ? "x,y,z, near the poses," : "first", " moves the origin"));
}

// Of the first frame that can be read; the first frame's error if none can.
absl::StatusOr<Pose> FirstSensorPose(const FrameSource& source) {
  absl::Status why;
  for (std::size_t i = 0; i < source.frame_count; ++i) {
    const absl::StatusOr<Frame> frame = source.read(i);
    if (frame.ok()) return frame->T_W_S;
    why.Update(frame.status());
  }
  return why;
}

}  // namespace

std::string OriginText(const Eigen::Vector3d& origin_m) {
  return absl::StrCat(Shortest(origin_m.x()), ",", Shortest(origin_m.y()), ",",
                      Shortest(origin_m.z()));
}

absl::StatusOr<LidarFolder> WithOrigin(LidarFolder folder,
                                       const std::optional<WorldOrigin>& origin) {
  if (origin && !folder.poses.empty()) {
    const Eigen::Vector3d origin_m =
        origin->at_first_pose ? folder.poses.front().T_W_S.translation : origin->position_m;
    for (RecordedPose& pose : folder.poses) pose.T_W_S.translation -= origin_m;
    for (RecordedBox& box : folder.boxes) box.T_W_B.translation -= origin_m;
    folder.frames = Moved(std::move(folder.frames), origin_m);
    if (folder.frames_without) {
      folder.frames_without = [without = std::move(folder.frames_without),
                               origin_m](const RowsLeftOut& rows) {
        return Moved(without(rows), origin_m);
      };
    }
  }
  const auto is_far = [](const RecordedPose& pose) { return IsFar(pose.T_W_S); };
  const auto far = static_cast<std::size_t>(std::ranges::count_if(folder.poses, is_far));
  if (2 * far <= folder.poses.size()) return folder;
  return TooFar(folder.frames, std::ranges::find_if(folder.poses, is_far)->T_W_S,
                origin.has_value());
}

absl::StatusOr<FrameSource> WithOrigin(FrameSource source,
                                       const std::optional<WorldOrigin>& origin) {
  if (source.frame_count == 0) return source;
  const absl::StatusOr<Pose> first = FirstSensorPose(source);
  if (!first.ok()) {  // whoever reads frames sees it
    if (!origin) return source;
    if (origin->at_first_pose) return first.status();
    return Moved(std::move(source), origin->position_m);
  }
  Pose T_W_S = *first;
  if (origin) {
    const Eigen::Vector3d origin_m =
        origin->at_first_pose ? first->translation : origin->position_m;
    T_W_S.translation -= origin_m;
    source = Moved(std::move(source), origin_m);
  }
  if (IsFar(T_W_S)) return TooFar(source, T_W_S, origin.has_value());
  return source;
}

}  // namespace clearway
