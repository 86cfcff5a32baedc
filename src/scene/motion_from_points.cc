#include "scene/motion_from_points.h"

#include <cmath>
#include <vector>

#include "scene/view_registration.h"

namespace clearway {
namespace {

// How far a pose may be off that is predicted so long ahead: by the object's velocity, or, if that
// is not known, because it may set out at once.
PoseGuess GuessOfTrack(const MovingObject& object, const Pose& T_W_O, double ahead_s) {
  constexpr double kUnknown_mps = 10;
  const double per_s = object.velocity_O ? 2.0 : kUnknown_mps;
  return {T_W_O, 0.05 + per_s * ahead_s, 0.01 + 0.3 * ahead_s};
}

// Where the points moved since they were seen last. What is seen of an object changes, the more the
// more their box does.
PoseGuess GuessOfView(const MovingObject& object, const Pose& T_W_O, const LastView& view,
                      std::span<const Eigen::Vector3d> points_W, double ahead_s) {
  const Pose T_O_W = Inverse(T_W_O);
  Eigen::Vector3d centroid_O = Eigen::Vector3d::Zero();
  Aabb box_O;
  for (const Eigen::Vector3d& p_W : points_W) {
    const Eigen::Vector3d p_O = T_O_W * p_W;
    centroid_O += p_O / static_cast<double>(points_W.size());
    box_O.Extend(p_O);
  }
  const double changed_m = (box_O.Size() - view.box_O.Size()).norm();
  Pose moved = T_W_O;
  moved.translation += T_W_O.rotation * (centroid_O - view.centroid_O);
  return {moved, std::hypot(object.map_O.grid().resolution_m(), 0.5 * changed_m),
          0.01 + 0.3 * ahead_s};
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
    guesses.push_back(GuessOfView(object, predicted, *object.last_view, points_W, ahead_s));
  }
  return RegisterView(object.map_O, points_W, guesses);
}

}  // namespace clearway
