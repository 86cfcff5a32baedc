#include "scene/point_placement.h"

#include <algorithm>
#include <vector>

#include "scene/mended_pose.h"
#include "scene/motion_from_points.h"
#include "scene/prediction_gate.h"

namespace clearway {
namespace {

// What is needed to move the position within the limits along each axis.
Eigen::Vector3d BackWithin(double limit_m, const Eigen::Vector3d& p_W) {
  return p_W.cwiseMax(-limit_m).cwiseMin(limit_m) - p_W;
}

// How far the object may be from where it is predicted. Of what was seen once nobody knows the
// speed.
double BoundAt(const MovingObject& object, Time t, bool is_estimated) {
  constexpr double kFastest_mps = 50;
  const double ahead_s = ToSeconds(t - object.LastPose().stamp);
  const double bound_m = object.bound.At(ahead_s);
  return is_estimated && !object.velocity_O ? std::max(bound_m, kFastest_mps * ahead_s) : bound_m;
}

}  // namespace

std::optional<ObjectIssue> PlaceByPoints(const MovingObject& object, const LabelledCloud& cloud,
                                         Time stamp, const SceneParams& params,
                                         const FrameLimits& limits, ObjectClue& clue) {
  const ObjectMotion* const motion = clue.motion;
  const bool is_chained = motion != nullptr && StartsAtAPose(*motion, object);
  if (clue.points.empty() || object.given() || is_chained) return {};
  // Until T_B_O is known a pose tells how the object moves from here on, but not where it is.
  if (clue.pose != nullptr && object.T_B_O) return {};
  if (object.t_k() >= stamp) return {};  // another frame of that stamp placed it
  const bool from_prediction = motion != nullptr && motion->from > object.t_k();
  const Time at = from_prediction ? motion->from : stamp;           // how far it is predicted
  const bool is_known = !object.future.empty() || !object.bridged;  // its newest pose
  const Time known_until =
      is_known ? std::max(object.placed_at, object.LastPose().stamp) : object.placed_at;
  const bool goes_on = !(object.LastVelocity() == Twist{});
  if (goes_on && at - known_until > params.horizon) {
    return ObjectIssue{ObjectIssueKind::kBridgedTooLong, object.id, ToSeconds(at - known_until),
                       ToSeconds(params.horizon)};
  }
  const bool is_estimated = motion == nullptr && MayBeEstimated(object, stamp, params);
  const std::vector<Eigen::Vector3d> points_W = EndsOf(cloud, clue.points);
  Pose T_W_O = motion != nullptr ? motion->H_W * StartOf(*motion, object, stamp, params)
                                 : PredictPose(object, stamp, params.horizon).T_W_O;
  const GateOffset offset = OffsetFrom(object, T_W_O, points_W);
  const double bound_m = BoundAt(object, at, is_estimated);
  if (!MeetsPrediction(offset, bound_m)) {
    return ObjectIssue{ObjectIssueKind::kRestarted, object.id, offset.off_W.norm(), bound_m};
  }
  if (is_estimated) {
    T_W_O = PoseFromPoints(object, points_W, stamp, params);
    T_W_O.translation += BackWithin(limits.max_coordinate_m, T_W_O.translation);
    clue.T_W_O_estimated = T_W_O;
  } else if (motion == nullptr) {
    T_W_O.translation += offset.exact_off_W;
    clue.off_W = offset.exact_off_W + BackWithin(limits.max_coordinate_m, T_W_O.translation);
  } else if (!params.MendsObjectPoses()) {
    clue.off_W = motion->H_W.rotation.conjugate() * offset.off_W;
  }
  return {};
}

}  // namespace clearway
