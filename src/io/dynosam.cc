#include "clearway/io/dynosam.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "io/dynosam_logs.h"
#include "io/lidar_frames.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// All that the logs hold.
struct Logs {
  std::vector<RecordedPose> poses;
  DynosamObjects object_poses, object_motions;
  DynosamPoints points;
  LeftOut left_out;
};

// What frames are made of besides poses. Shared by the copies of a FrameSource.
struct Content {
  DynosamPoints points;
  std::map<int, std::vector<ObjectMotion>> motions;  // by frame
  int first_frame = 0;                               // that static points of no frame come with
};

// Rows that become nothing.
struct Unused {
  std::size_t without_pose = 0;  // of frames that have no camera pose
  std::size_t without_start = 0;
};

double Turn_rad(const Pose& pose) {
  return 2 * std::atan2(pose.rotation.vec().norm(), std::abs(pose.rotation.w()));
}

// As DynoSAM's own test of a motion from a frame to itself.
bool IsIdentity(const Pose& pose) {
  constexpr double kTolerance = 1e-4;
  return pose.translation.cwiseAbs().maxCoeff() <= kTolerance && Turn_rad(pose) <= kTolerance;
}

// The time that a motion starts from; null if there is none: the frame before has no pose, or it is
// the identity with which an object's track begins, of which nothing is known before.
const RecordedPose* StartOf(const Logs& logs, int frame, ObjectId id, const Pose& H_W) {
  const bool is_first = !logs.object_motions.contains({frame - 1, id});
  return is_first && IsIdentity(H_W) ? nullptr : PoseOf(logs.poses, frame - 1);
}

std::map<int, std::vector<ObjectMotion>> MotionsOf(const Logs& logs, Unused& unused) {
  std::map<int, std::vector<ObjectMotion>> motions;
  for (const auto& [key, H_W] : logs.object_motions) {
    const auto [frame, id] = key;
    const RecordedPose* const start = StartOf(logs, frame, id, H_W);
    if (PoseOf(logs.poses, frame) == nullptr) {
      ++unused.without_pose;
    } else if (start == nullptr) {
      ++unused.without_start;
    } else {
      motions[frame].push_back({id, H_W, start->stamp});
    }
  }
  return motions;
}

std::vector<RecordedBox> BoxesOf(const Logs& logs, Unused& unused) {
  constexpr int kNotSaid = -1;
  std::vector<RecordedBox> boxes;
  for (const auto& [key, T_W_B] : logs.object_poses) {
    const auto [frame, id] = key;
    if (PoseOf(logs.poses, frame) == nullptr) {
      ++unused.without_pose;
      continue;
    }
    boxes.push_back({frame, id, "object", Eigen::Vector3d::Zero(), T_W_B, kNotSaid});
  }
  return boxes;
}

absl::StatusOr<Logs> ReadLogs(const DynosamModule& module, const DynosamOptions& options) {
  Logs logs;
  auto poses = ReadDynosamCamera(module, options.frame_period, logs.left_out);
  if (!poses.ok()) return poses.status();
  auto object_poses = ReadDynosamObjects(module.Log("object_pose"), logs.left_out);
  if (!object_poses.ok()) return object_poses.status();
  auto motions = ReadDynosamObjects(module.Log("object_motion"), logs.left_out);
  if (!motions.ok()) return motions.status();
  logs.poses = *std::move(poses);
  logs.object_poses = *std::move(object_poses);
  logs.object_motions = *std::move(motions);
  auto points = ReadDynosamPoints(module.Log("map_points"), logs.poses, logs.left_out);
  if (points.ok()) {
    logs.points = *std::move(points);
  } else if (!absl::IsNotFound(points.status()) || !options.allow_missing_points) {
    return points.status();
  }
  return logs;
}

// Static points of no frame: each is its own ray's origin.
void AddUnframed(const DynosamPoints& points, Frame& frame) {
  frame.origins_S.assign(frame.points_S.size(), Eigen::Vector3f::Zero());
  const Pose T_S_W = Inverse(frame.T_W_S);
  for (const Eigen::Vector3d& p_W : points.unframed_W) {
    frame.points_S.push_back((T_S_W * p_W).cast<float>());
    frame.origins_S.push_back(frame.points_S.back());
    frame.labels.push_back(kStaticLabel);
  }
}

void Fill(const Content& content, Frame& frame) {
  const int number = static_cast<int>(frame.sequence);
  if (const auto cloud = content.points.clouds.find(number); cloud != content.points.clouds.end()) {
    frame.points_S = cloud->second.points_S;
    frame.labels = cloud->second.labels;
  }
  if (number == content.first_frame && !content.points.unframed_W.empty()) {
    AddUnframed(content.points, frame);
  }
  if (const auto motions = content.motions.find(number); motions != content.motions.end()) {
    frame.motions = motions->second;
  }
}

std::string Described(const std::string& name, const Content& content, const Unused& unused) {
  std::vector<std::string> parts = {name};
  const auto add = [&parts](std::size_t count, const char* what) {
    if (count > 0) parts.push_back(absl::StrCat(count, " ", what));
  };
  add(content.points.unframed_W.size(), "static points of no frame come with the first");
  add(unused.without_pose, "rows of frames without a camera pose are left out");
  add(unused.without_start, "motions that start at no known frame are left out");
  return absl::StrJoin(parts, "; ");
}

int FirstFrame(const std::vector<RecordedPose>& poses, int from) {
  const auto first = std::ranges::lower_bound(poses, from, {}, &RecordedPose::frame);
  return first == poses.end() ? from : first->frame;
}

std::shared_ptr<const Content> ContentOf(Logs& logs, const DynosamOptions& options,
                                         Unused& unused) {
  const auto content = std::make_shared<Content>();
  unused.without_pose += logs.points.without_pose;
  auto motions = MotionsOf(logs, unused);
  if (options.objects == LidarObjects::kMotions) content->motions = std::move(motions);
  content->points = std::move(logs.points);
  content->first_frame = FirstFrame(logs.poses, options.first_frame);
  return content;
}

}  // namespace

bool IsDynosam(const Path& path) { return !absl::IsNotFound(FindDynosamModule(path).status()); }

absl::StatusOr<LidarFolder> OpenDynosam(const Path& given, const DynosamOptions& options) {
  if (auto status = CheckFramePeriod(options.frame_period); !status.ok()) return status;
  std::error_code error;
  const auto module = FindDynosamModule(std::filesystem::absolute(given, error).lexically_normal());
  if (!module.ok()) return module.status();
  auto logs = ReadLogs(*module, options);
  if (!logs.ok()) return logs.status();
  Unused unused;
  const auto content = ContentOf(*logs, options, unused);
  LidarScans scans;
  scans.has_motions = true;
  scans.name = absl::StrCat("DynoSAM logs ", (module->folder / module->name).string(), "_*");
  scans.options = {.objects = options.objects,
                   .first_frame = options.first_frame,
                   .last_frame = options.last_frame,
                   .sensor_id = options.sensor_id};
  scans.boxes = BoxesOf(*logs, unused);
  scans.poses = std::move(logs->poses);
  *scans.left_out = std::move(logs->left_out);
  scans.points_of = [log = module->Log("camera_pose")](int) { return log; };
  scans.read = [content](const Path&, std::span<const RecordedBox>, Frame& frame) {
    Fill(*content, frame);
    return absl::OkStatus();
  };
  const std::string description = Described(scans.name, *content, unused);
  absl::StatusOr<LidarFolder> result = FramesOf(std::move(scans));
  if (result.ok()) result->frames.description = description;
  return result;
}

}  // namespace clearway
