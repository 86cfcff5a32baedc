#include "scene/motion_from_points.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "scene/view_registration.h"

namespace clearway {
namespace {

// The means of the points of each voxel. Near the sensor points are denser: a mean over all of them
// would follow the sensor along an object's side.
std::vector<Eigen::Vector3d> Thinned(std::span<const Eigen::Vector3d> points, double voxel_m) {
  struct Sum {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
  };
  std::map<std::array<std::int64_t, 3>, Sum> sums;  // ordered: the result must not depend on hashes
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d at = (p / voxel_m).array().floor();
    Sum& sum = sums[{static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()),
                     static_cast<std::int64_t>(at.z())}];
    sum.sum += p;
    ++sum.count;
  }
  std::vector<Eigen::Vector3d> means;
  means.reserve(sums.size());
  for (const auto& [key, sum] : sums) means.push_back(sum.sum / sum.count);
  return means;
}

LastView ViewOfThinned(std::span<const Eigen::Vector3d> points, const Pose& T_O_P, Time stamp) {
  LastView view;
  view.stamp = stamp;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d p_O = T_O_P * p;
    view.centroid_O += p_O / static_cast<double>(points.size());
    view.box_O.Extend(p_O);
  }
  return view;
}

// The turn about W's z alone.
Eigen::Quaterniond YawOf(const Eigen::Quaterniond& turn) {
  const Eigen::AngleAxisd angle_axis(turn);
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(angle_axis.angle() * angle_axis.axis().z(), Eigen::Vector3d::UnitZ()));
}

// How far a pose may be off that is predicted so long ahead: by the object's velocity, or, if that
// is not known, because it may set out at once. Along z and about level axes much less: a few beams
// that sweep over an object look like a view of it that rises or tilts. It does not go on tilting.
PoseGuess GuessOfTrack(const MovingObject& object, Time stamp, const SceneParams& params) {
  constexpr double kUnknown_mps = 10, kKnown_mps = 4;
  constexpr double kClimb_mps = 0.3;
  const double ahead_s = ToSeconds(stamp - object.t_k());
  const Eigen::Quaterniond& before = object.history.back().T_W_O.rotation;
  Pose T_W_O = PredictPose(object, stamp, params.horizon).T_W_O;
  T_W_O.rotation = YawOf(T_W_O.rotation * before.conjugate()) * before;
  const double level_m = 0.05 + (object.velocity_O ? kKnown_mps : kUnknown_mps) * ahead_s;
  const double climb_m = 0.01 + kClimb_mps * ahead_s;
  const double tilt_rad = 0.001 + 0.005 * ahead_s, yaw_rad = 0.01 + 0.2 * ahead_s;
  return {T_W_O, {level_m, level_m, climb_m}, {tilt_rad, tilt_rad, yaw_rad}};
}

// Where the points moved since they were seen last, if it did not turn: what is too small or too
// round to show how it turns is not to turn ever faster. What is seen of an object changes, the
// more the more the points' box does.
PoseGuess GuessOfView(const MovingObject& object, const LastView& last,
                      std::span<const Eigen::Vector3d> points_W, Time stamp) {
  constexpr double kVoxels = 1.5, kClimb_m = 0.3;
  const Eigen::Quaterniond& turned = object.history.back().T_W_O.rotation;
  const Pose unturned{turned.conjugate(), Eigen::Vector3d::Zero()};
  const LastView now = ViewOfThinned(points_W, unturned, stamp);
  const double changed_m = (now.box_O.Size() - last.box_O.Size()).norm();
  const double level_m = std::hypot(kVoxels * object.map_O.grid().resolution_m(), changed_m);
  const double turn_rad = 0.01 + 0.5 * ToSeconds(stamp - last.stamp);
  return {{turned, turned * (now.centroid_O - last.centroid_O)},
          {level_m, level_m, kClimb_m},
          Eigen::Vector3d::Constant(turn_rad)};
}

}  // namespace

bool MayBeEstimated(const MovingObject& object, Time stamp, const SceneParams& params) {
  constexpr Duration kPause = std::chrono::milliseconds(600);  // keyframes at 2 Hz, and jitter
  if (object.given() || params.motion_from_points == MotionFromPoints::kOff) return false;
  if (params.motion_from_points == MotionFromPoints::kOn || !object.reported) return true;
  return object.future.empty() && stamp - object.placed_at > kPause;
}

LastView ViewOf(std::span<const Eigen::Vector3d> points_W, const Pose& T_O_W, Time stamp,
                const SceneParams& params) {
  return ViewOfThinned(Thinned(points_W, params.object_resolution_m), T_O_W, stamp);
}

Pose PoseFromPoints(const MovingObject& object, std::span<const Eigen::Vector3d> points_W,
                    Time stamp, const SceneParams& params) {
  const std::vector<Eigen::Vector3d> thinned_W = Thinned(points_W, params.object_resolution_m);
  std::vector<PoseGuess> guesses = {GuessOfTrack(object, stamp, params)};
  if (object.last_view) {
    guesses.push_back(GuessOfView(object, *object.last_view, thinned_W, stamp));
  }
  return RegisterView(object.map_O, thinned_W, guesses);
}

}  // namespace clearway
