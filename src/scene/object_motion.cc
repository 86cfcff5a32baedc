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

}  // namespace

Eigen::Vector3d CenterOf(const Solid& solid) {
  return solid.box_O.Empty() ? Eigen::Vector3d::Zero() : solid.box_O.Center();
}

Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params) {
  if (StayedWithin(track, solid.radius_m, params.rest_distance_m)) return {};
  if (params.motion == MotionModel::kLastMotion || track.size() < 2) return last_motion_O;
  const StampedPose* const before = StepBefore(track, track.back().stamp);
  if (before != nullptr && TurnsTooFar(*before, track.back())) return last_motion_O;
  return VelocityOfTrack(track, CenterOf(solid));
}

Twist GoesOnByItself(std::span<const StampedPose> track, const Solid& solid,
                     const SceneParams& params) {
  return GoesOn(track, LastMotionOf(track), solid, params);
}

const StampedPose* StepBefore(std::span<const StampedPose> track, Time stamp) {
  const auto before = std::find_if(track.rbegin(), track.rend(), [&](const StampedPose& pose) {
    return pose.stamp + kShortestStep <= stamp;
  });
  return before == track.rend() ? nullptr : &*before;
}

bool TurnsTooFar(const StampedPose& before, const StampedPose& after) {
  return before.T_W_O.rotation.angularDistance(after.T_W_O.rotation) > kMaxTurn_rad;
}

Twist LastMotionOf(std::span<const StampedPose> track) {
  const StampedPose* const before = StepBefore(track, track.back().stamp);
  return before == nullptr ? Twist{} : VelocityBetween(*before, track.back());
}

}  // namespace clearway
