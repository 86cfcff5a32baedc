#include "clearway/io/within_scene.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/io/world_origin.h"
#include "io/lidar_frames.h"

namespace clearway {
namespace {

bool IsFar(const Eigen::Vector3d& p_W) {
  return !(p_W.cwiseAbs().maxCoeff() <= FrameLimits().max_coordinate_m);
}

std::string FarText(const Eigen::Vector3d& p_W) {
  return absl::StrCat("is at ", OriginText(p_W), ", beyond the limit of ",
                      NumberText(FrameLimits().max_coordinate_m), " m");
}

// Why a pose cannot be used by itself; empty if it can.
std::string WhyUnusable(const RecordedPose& pose) {
  if (IsFar(pose.T_W_S.translation)) return "the sensor " + FarText(pose.T_W_S.translation);
  const std::int64_t stamp_ns = ToNanoseconds(pose.stamp);
  if (stamp_ns > kFarthest_ns || stamp_ns < -kFarthest_ns) {
    return absl::StrCat("the stamp ", stamp_ns, " ns is beyond the limit of 2^62 ns");
  }
  return "";
}

bool IsJump(const RecordedPose& from, const RecordedPose& to) {
  return std::chrono::abs(to.stamp - from.stamp) > FrameLimits().max_stamp_jump;
}

// Whether the first pose is far from a second and third in time that are near each other.
template <class Iterator>
bool IsAlone(Iterator first, Iterator end) {
  return std::distance(first, end) >= 3 && IsJump(*first, *std::next(first)) &&
         !IsJump(*std::next(first), *std::next(first, 2));
}

std::string AloneText(const RecordedPose& pose, const RecordedPose& next) {
  const auto seconds = [](Duration duration) {
    return std::chrono::duration_cast<std::chrono::seconds>(duration).count();
  };
  return absl::StrCat("the stamp ", ToNanoseconds(pose.stamp), " ns lies ",
                      seconds(std::chrono::abs(pose.stamp - next.stamp)),
                      " s from that of the frame next to it; the limit is ",
                      seconds(FrameLimits().max_stamp_jump), " s");
}

// The poses that can be used. Why others cannot goes to left_out.
std::vector<RecordedPose> UsablePoses(const std::vector<RecordedPose>& poses, LeftOut& left_out) {
  const auto leave_out = [&](const RecordedPose& pose, const std::string& why) {
    left_out.AddFrame(absl::StrCat("frame ", pose.frame, ": ", why));
  };
  std::vector<RecordedPose> usable;
  for (const RecordedPose& pose : poses) {
    const std::string why = WhyUnusable(pose);
    why.empty() ? usable.push_back(pose) : leave_out(pose, why);
  }
  if (IsAlone(usable.begin(), usable.end())) {
    leave_out(usable[0], AloneText(usable[0], usable[1]));
    usable.erase(usable.begin());
  }
  if (IsAlone(usable.rbegin(), usable.rend())) {
    leave_out(usable.back(), AloneText(usable.back(), *std::next(usable.rbegin())));
    usable.pop_back();
  }
  return usable;
}

// Nobody takes 5,000 scans a second: such stamps are of another unit, and nothing in the recording
// would have a velocity.
absl::Status CheckUnit(const std::vector<RecordedPose>& poses) {
  constexpr std::size_t kFew = 3;
  constexpr Duration kShortest = std::chrono::microseconds(200);
  if (poses.size() < kFew) return absl::OkStatus();
  std::vector<Duration> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    steps.push_back(poses[i].stamp - poses[i - 1].stamp);
  }
  const auto median = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, median);
  if (*median <= Duration::zero() || *median >= kShortest) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("most of the ", poses.size(), " frames' stamps are ", median->count(),
                   " ns apart or less; are the stamps of another unit than nanoseconds?"));
}

// The frames of the others. Far boxes of frames that count go to left_out.
RowsLeftOut RowsBut(const std::vector<RecordedPose>& usable, const LidarFolder& folder,
                    LeftOut& left_out) {
  RowsLeftOut rows;
  for (const RecordedPose& pose : folder.poses) {
    if (PoseOf(usable, pose.frame) == nullptr) rows.frames.insert(pose.frame);
  }
  for (const RecordedBox& box : folder.boxes) {
    if (rows.Has(box) || !IsFar(box.T_W_B.translation)) continue;
    rows.boxes.emplace(box.frame, box.id);
    left_out.AddRow(absl::StrCat("frame ", box.frame, ", object ", box.id, ": the box ",
                                 FarText(box.T_W_B.translation)));
  }
  return rows;
}

// As if the tables did not have the rows.
void LeaveOut(const RowsLeftOut& rows, LidarFolder& folder) {
  const int first_frame =
      folder.first_pose < folder.poses.size() ? folder.poses[folder.first_pose].frame : 0;
  FrameSource frames = folder.frames_without(rows);
  folder.frames.frame_count = frames.frame_count;
  folder.frames.read = std::move(frames.read);
  std::erase_if(folder.poses, [&](const RecordedPose& pose) { return rows.Has(pose); });
  std::erase_if(folder.boxes, [&](const RecordedBox& box) { return rows.Has(box); });
  std::erase_if(folder.missing_points,
                [&](const auto& missing) { return rows.frames.contains(missing.first); });
  folder.first_pose = static_cast<std::size_t>(
      std::ranges::lower_bound(folder.poses, first_frame, {}, &RecordedPose::frame) -
      folder.poses.begin());
}

}  // namespace

absl::StatusOr<LidarFolder> WithinScene(LidarFolder folder) {
  LeftOut of_scene;
  const std::vector<RecordedPose> usable = UsablePoses(folder.poses, of_scene);
  if (auto status = CheckUnit(usable); !status.ok()) {
    return absl::Status(status.code(),
                        absl::StrCat(folder.frames.description, ": ", status.message()));
  }
  const RowsLeftOut rows = RowsBut(usable, folder, of_scene);
  if (of_scene.Empty()) return folder;
  if (!folder.frames_without && !usable.empty()) {
    return absl::FailedPreconditionError(absl::StrCat(
        folder.frames.description, ": no reader opened it, so nothing can be left out of it"));
  }
  if (!usable.empty()) LeaveOut(rows, folder);
  if (usable.empty() || folder.frames.frame_count == 0) {
    return absl::InvalidArgumentError(absl::StrCat(
        folder.frames.description, ": no frame can be used; ", of_scene.reasons.front()));
  }
  folder.frames.left_out->Add(of_scene);
  return folder;
}

}  // namespace clearway
