// What a Dynamic SLAM system says at one instant.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// An object's id, which is also the label of its points.
using ObjectId = std::int32_t;
inline constexpr ObjectId kStaticLabel = 0;   // background
inline constexpr ObjectId kIgnoreLabel = -1;  // leave the point out

// H_W of eq. (2): T_W_O(stamp of the frame) = H_W * T_W_O(from).
struct ObjectMotion {
  ObjectId id = 0;
  Pose H_W;
  Time from;  // before the frame's stamp
};

// The pose of the source's own box B of an object, where the source tracks poses instead of
// motions.
struct ObjectPose {
  ObjectId id = 0;
  Pose T_W_B;
};

// That an object is a part of another, which is then articulated (a truck and its trailer) or not
// rigid (a cyclist and his legs): each part is rigid, has a label, a motion and a map of its own,
// and together they are one object that is listed, predicted and dropped as one. The whole goes by
// the id of its main part, which is a part of nothing.
struct ObjectPart {
  ObjectId id = 0;
  ObjectId whole = 0;  // 0: a part of nothing any more
  bool operator==(const ObjectPart&) const = default;
};

// One labelled scan with the poses and motions that belong to it. Points are expected
// motion-compensated to `stamp`. Plain data: Validate says whether it is well formed. Points that
// are NaN or infinite are no error: they are dropped and counted.
struct Frame {
  // The three together name the frame.
  std::string sensor_id;
  std::uint64_t sensor_run = 0;  // of this start of the sensor, at random; 0: not given
  std::uint64_t sequence = 0;
  Time stamp;
  Pose T_W_S;

  std::vector<Eigen::Vector3f> points_S;  // metres
  std::vector<ObjectId> labels;           // one per point
  // Empty, or one per point: non-zero marks a ray without a return, which clears up to the point
  // and hits nothing.
  std::vector<std::uint8_t> no_return;
  // Empty (every ray starts at S's origin), or one per point.
  std::vector<Eigen::Vector3f> origins_S;

  std::vector<ObjectMotion> motions;  // at most one of motion and pose per object
  std::vector<ObjectPose> poses;

  // Holds until another frame says otherwise. Of objects that the scene does not have (yet) it is
  // forgotten: a source does well to say it in every frame. Of a part without motion and pose, its
  // whole's tells where it goes.
  std::vector<ObjectPart> parts;
};

// The direction of a larger turn is ambiguous: a motion that turns by more is left out
// (ObjectIssueKind::kTurnTooLarge).
inline constexpr double kMaxTurn_rad = 0.9 * std::numbers::pi;
// Nothing that Clearway maps is faster: a motion or pose that says so is left out
// (ObjectIssueKind::kMotionTooFast).
inline constexpr double kMaxSpeed_mps = 1'000;

// Bounds on what a frame may hold, and the scene after it.
struct FrameLimits {
  std::size_t max_points = 2'000'000;
  // That rays pass, each counted as often as it is passed. A few rays of many kilometres would
  // keep the scene busy for minutes.
  std::uint64_t max_ray_voxels = std::uint64_t{1} << 29;
  std::size_t max_objects = 4'096;
  double max_coordinate_m = 100'000;  // of positions; also bounded by what the grid can address
  // Of 8 x 8 x 8 voxels, in all maps of the scene together: 1.3 KB each, up to 3 KB if scattered.
  std::size_t max_blocks = std::size_t{1} << 22;
  // How far a stamp may lie after the scene's newest: a clock that jumped would lock out all
  // others.
  Duration max_stamp_jump = std::chrono::hours(1);
  // How far it may lie before that, if newer frames came from other sensors only.
  Duration late_window = std::chrono::milliseconds(200);
  bool operator==(const FrameLimits&) const = default;
};

// INVALID_ARGUMENT or RESOURCE_EXHAUSTED, naming the field as in the wire format
// ("motions[2].world_motion") and the limit: arrays of different lengths, labels below -1, poses
// or motions that are not finite or not of unit rotation, ids that occur twice, parts of themselves
// or of parts, a motion that does not start before the stamp. Motions that are well formed but
// implausible are left out when the frame is applied (ObjectIssueKind).
absl::Status Validate(const Frame& frame, const FrameLimits& limits);

// INVALID_ARGUMENT for a stamp of more than 2^62 ns either way: differences of stamps must not
// overflow.
absl::Status ValidateStamp(const std::string& field, Time stamp);

// Checks one pose; `field` names it in the message.
absl::Status ValidatePose(const std::string& field, const Pose& pose, double max_coordinate_m);

}  // namespace clearway
