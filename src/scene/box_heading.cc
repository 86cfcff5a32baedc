#include "scene/box_heading.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "scene/object_motion.h"

namespace clearway {
namespace {

// T_B_O of a box that is turned by R_B about that point of O, while the object is not.
Pose Turned(const Pose& T_B_O, const Eigen::Quaterniond& R_B, const Eigen::Vector3d& point_O) {
  const Eigen::Vector3d point_B = T_B_O * point_O;
  return Pose{R_B, point_B - R_B * point_B} * T_B_O;
}

// What turns the box to the heading that is predicted for the object, or close to it.
Eigen::Quaterniond HeadingError(const Pose& T_W_B, const Pose& T_B_O,
                                const Eigen::Quaterniond& R_W_O) {
  constexpr double kNear_rad = 0.15;
  for (const int quarters : {1, 2, 3}) {
    const Eigen::Quaterniond R_B(
        Eigen::AngleAxisd(quarters * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
    if (R_W_O.angularDistance(T_W_B.rotation * R_B * T_B_O.rotation) < kNear_rad) return R_B;
  }
  return T_W_B.rotation.conjugate() * R_W_O * T_B_O.rotation.conjugate();
}

}  // namespace

Pose FrameInBox(const ObjectPose& pose, Time stamp, const SceneParams& params,
                const MovingObject& object) {
  const Pose &T_W_B = pose.T_W_B, &T_B_O = *object.T_B_O;
  const Duration ahead = stamp - object.t_k();
  if (object.given() || ahead <= Duration::zero() || ahead > kMaxGapOfHeadings) return T_B_O;
  const Pose predicted = PredictPose(object, stamp, params.horizon).T_W_O;
  const double turn_rad = predicted.rotation.angularDistance(T_W_B.rotation * T_B_O.rotation);
  if (turn_rad <= MaxTurn_rad(ToSeconds(ahead))) return T_B_O;

  // It is turned about its own origin, or, if that is not its middle, about the object's.
  const Eigen::Quaterniond R_B = HeadingError(T_W_B, T_B_O, predicted.rotation);
  Pose best = T_B_O;
  double least_m = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& point_O :
       std::array{Inverse(T_B_O).translation, CenterOf(*object.solid)}) {
    const Pose turned = Turned(T_B_O, R_B, point_O);
    const double off_m = ((T_W_B * turned).translation - predicted.translation).norm();
    if (off_m < least_m) best = turned;
    least_m = std::min(least_m, off_m);
  }
  return best;
}

}  // namespace clearway
