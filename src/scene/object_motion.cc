#include "scene/object_motion.h"

#include <algorithm>
#include <cmath>

#include "scene/track_motion.h"

namespace clearway {
namespace {

// Whether nothing of the object went further than `distance_m` in the rest window before its newest
// pose, as far as its poses tell.
bool StayedWithin(std::span<const StampedPose> track, double radius_m, double distance_m) {
  const StampedPose& last = track.back();
  for (std::size_t i = track.size(); i-- > 0;) {
    const double turned_rad = track[i].T_W_O.rotation.angularDistance(last.T_W_O.rotation);
    const double moved_m = (track[i].T_W_O.translation - last.T_W_O.translation).norm();
    if (moved_m + turned_rad * radius_m >= distance_m) return false;
    if (last.stamp - track[i].stamp >= kRestWindow) return true;
  }
  return false;  // not known for so long
}

// To within what headings that are right are off by.
bool HaveOneHeading(const Pose& a, const Pose& b) {
  constexpr double kNoise_rad = 0.3;
  static const double kCosOfHalf = std::cos(kNoise_rad / 2);
  return std::abs(a.rotation.dot(b.rotation)) > kCosOfHalf;
}

// What comes after its last step that turns too far.
std::span<const StampedPose> SinceItTurned(std::span<const StampedPose> track,
                                           const BodyBox& body) {
  for (std::size_t i = track.size(); i-- > 1;) {
    if (TurnsTooFar(track[i - 1], track[i], body)) return track.subspan(i);
  }
  return track;
}

Eigen::Vector3d Shortened(const Eigen::Vector3d& v, double longest) {
  const double length = v.norm();
  return length <= longest ? v : Eigen::Vector3d(v * (longest / length));
}

}  // namespace

Eigen::Vector3d CenterOf(const Solid& solid) {
  return solid.box_O.Empty() ? Eigen::Vector3d::Zero() : solid.box_O.Center();
}

BodyBox BoxOf(const Solid& solid) {
  if (solid.box_O.Empty()) return {};
  return {solid.box_O.Center(), 0.5 * solid.box_O.Size()};
}

Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params) {
  if (StayedWithin(track, solid.radius_m, params.rest_distance_m)) return {};
  if (params.motion == MotionModel::kLastMotion) return last_motion_O;
  const BodyBox body = BoxOf(solid);
  track = SinceItTurned(track, body);
  return track.size() < 2 ? last_motion_O : VelocityOfTrack(track, body.center_O);
}

Twist GoesOnByItself(std::span<const StampedPose> track, const Solid& solid,
                     const SceneParams& params) {
  const StampedPose* const before = StepBefore(track, track.back().stamp);
  if (before == nullptr) return GoesOn(track, {}, solid, params);
  return GoesOn(track, VelocityOfStep(*before, track.back(), BoxOf(solid)), solid, params);
}

const StampedPose* StepBefore(std::span<const StampedPose> track, Time stamp) {
  const auto before = std::find_if(track.rbegin(), track.rend(), [&](const StampedPose& pose) {
    return pose.stamp + kShortestStep <= stamp;
  });
  return before == track.rend() ? nullptr : &*before;
}

double MaxTurn_rad(double seconds) {
  constexpr double kNoise_rad = 0.3, kTurnRate_radps = 6;
  return std::min(kNoise_rad + kTurnRate_radps * seconds, kMaxTurn_rad);
}

bool TurnsTooFar(const StampedPose& before, const StampedPose& after, const BodyBox& body) {
  constexpr double kInwards_mps2 = 7;
  const Pose &from = before.T_W_O, &to = after.T_W_O;
  if (HaveOneHeading(from, to)) return false;
  const Eigen::AngleAxisd turn(from.rotation.conjugate() * to.rotation);
  const double step_s = ToSeconds(after.stamp - before.stamp);
  if (turn.angle() > MaxTurn_rad(step_s)) return true;
  const double moved_m = (to * body.center_O - from * body.center_O).norm();
  const double corner_m = body.half_size_m.cross(turn.axis().cwiseAbs()).norm();  // from the axis
  return turn.angle() * std::max(moved_m, turn.angle() * corner_m) >
         kInwards_mps2 * step_s * step_s;
}

const StampedPose* PoseAlike(std::span<const StampedPose> track, const StampedPose& pose) {
  constexpr Duration kLately = std::chrono::milliseconds(500);
  const auto alike = std::find_if(track.rbegin(), track.rend(), [&](const StampedPose& before) {
    return before.stamp + kShortestStep <= pose.stamp && HaveOneHeading(before.T_W_O, pose.T_W_O);
  });
  return alike == track.rend() || pose.stamp - alike->stamp > kLately ? nullptr : &*alike;
}

Twist VelocityOfStep(const StampedPose& before, const StampedPose& after, const BodyBox& body,
                     const std::optional<Twist>& until_then) {
  if (!TurnsTooFar(before, after, body)) return VelocityBetween(before, after);
  constexpr double kAcceleration_mps2 = 10;
  const Eigen::Vector3d& center_O = body.center_O;
  const Pose &from = before.T_W_O, &to = after.T_W_O;
  const double step_s = ToSeconds(after.stamp - before.stamp);
  Eigen::Vector3d center_W_mps = (to * center_O - from * center_O) / step_s;
  Eigen::Vector3d turn_W_radps = Eigen::Vector3d::Zero();
  if (until_then) {
    turn_W_radps = from.rotation * until_then->angular;
    const Eigen::Vector3d center_O_mps = until_then->linear + until_then->angular.cross(center_O);
    const Eigen::Vector3d before_W_mps = from.rotation * center_O_mps;
    center_W_mps =
        before_W_mps + Shortened(center_W_mps - before_W_mps, kAcceleration_mps2 * step_s);
  }
  const Eigen::Quaterniond R_O_W = to.rotation.conjugate();
  const Eigen::Vector3d angular_O = R_O_W * turn_W_radps;
  return {angular_O, R_O_W * center_W_mps - angular_O.cross(center_O)};
}

Twist LastMotionOf(std::span<const StampedPose> track) {
  const StampedPose* const before = StepBefore(track, track.back().stamp);
  return before == nullptr ? Twist{} : VelocityBetween(*before, track.back());
}

}  // namespace clearway
