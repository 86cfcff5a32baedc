#include "scene/motion_from_points.h"

#include <cmath>
#include <vector>

#include "scene/view_registration.h"

namespace clearway {
namespace {

double TurnSigma_rad(double ahead_s) { return 0.01 + 0.5 * ahead_s; }

// How far a pose may be off that is predicted so long ahead: by the object's velocity, or, if that
// is not known, because it may set out at once.
PoseGuess GuessOfTrack(const MovingObject& object, const Pose& T_W_O, double ahead_s) {
  constexpr double kUnknown_mps = 10, kKnown_mps = 2;
  const double per_s = object.velocity_O ? kKnown_mps : kUnknown_mps;
  return {T_W_O, 0.05 + per_s * ahead_s, TurnSigma_rad(ahead_s)};
}

// Where the points moved since they were seen last, if it did not turn: what is too small or too
// round to show how it turns is not to turn ever faster. What is seen of an object changes, the
// more the more the points' box does.
PoseGuess GuessOfView(const MovingObject& object, const LastView& view,
                      std::span<const Eigen::Vector3d> points_W, Time stamp) {
  const Eigen::Quaterniond& turned = object.history.back().T_W_O.rotation;
  Eigen::Vector3d centroid_W = Eigen::Vector3d::Zero();
  Aabb box;
  for (const Eigen::Vector3d& p_W : points_W) {
    centroid_W += p_W / static_cast<double>(points_W.size());
    box.Extend(turned.conjugate() * p_W);
  }
  const double changed_m = (box.Size() - view.box_O.Size()).norm();
  return {{turned, centroid_W - turned * view.centroid_O},
          std::hypot(object.map_O.grid().resolution_m(), changed_m),
          TurnSigma_rad(ToSeconds(stamp - view.stamp))};
}

}  // namespace

bool MayBeEstimated(const MovingObject& object, const SceneParams& params) {
  if (object.given() || params.motion_from_points == MotionFromPoints::kOff) return false;
  return params.motion_from_points == MotionFromPoints::kOn || !object.reported;
}

Pose PoseFromPoints(const MovingObject& object, std::span<const Eigen::Vector3d> points_W,
                    Time stamp, const SceneParams& params) {
  const double ahead_s = ToSeconds(stamp - object.t_k());
  const Pose predicted = PredictPose(object, stamp, params.horizon).T_W_O;
  std::vector<PoseGuess> guesses = {GuessOfTrack(object, predicted, ahead_s)};
  if (object.last_view) {
    guesses.push_back(GuessOfView(object, *object.last_view, points_W, stamp));
  }
  return RegisterView(object.map_O, points_W, guesses);
}

}  // namespace clearway
