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

Eigen::Vector3d CenterOf(const Solid& solid) {
  return solid.box_O.Empty() ? Eigen::Vector3d::Zero() : solid.box_O.Center();
}

constexpr Duration kHalf = std::chrono::milliseconds(500), kWhole = 2 * kHalf;

// Between the first pose of the track and the last.
Pose PoseAt(std::span<const StampedPose> track, Time t) {
  const auto after = std::ranges::lower_bound(track, t, {}, &StampedPose::stamp);
  if (after == track.begin()) return after->T_W_O;
  const StampedPose& before = *(after - 1);
  const double share = ToSeconds(t - before.stamp) / ToSeconds(after->stamp - before.stamp);
  return Interpolate(before.T_W_O, after->T_W_O, share);
}

// How much of what is usual for fast objects is usual for one of that speed.
double ShareOfUsual(double speed_mps) {
  constexpr double kFast_mps = 4, kNeverBelow_mps = 0.7;
  return std::min(1.0, (speed_mps + kNeverBelow_mps) / kFast_mps);
}

}  // namespace

Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params) {
  if (StayedWithin(track, solid.radius_m, params.rest_distance_m)) return {};
  if (params.motion == MotionModel::kLastMotion || track.size() < 2) return last_motion_O;
  return VelocityOfTrack(track, CenterOf(solid));
}

double Misses::Scale_m(double usual_m) const {
  constexpr double kUsualCount = 4;  // what is usual counts as much as so many predictions
  return std::sqrt((kUsualCount * usual_m * usual_m + sum_m2_) / (kUsualCount + count_));
}

PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by) {
  constexpr int kPredictions = 10;
  const auto first = std::ranges::lower_bound(track, since, {}, &StampedPose::stamp);
  track = track.last(static_cast<std::size_t>(track.end() - first));
  const Eigen::Vector3d center_O = CenterOf(solid);
  PastMisses misses;
  if (track.empty()) return misses;
  const Time last = track.back().stamp;
  std::size_t known = track.size();
  for (int i = 1; i <= kPredictions; ++i) {
    const auto later =
        std::ranges::upper_bound(track.first(known), last - i * kHalf, {}, &StampedPose::stamp);
    const auto count = static_cast<std::size_t>(later - track.begin());
    if (count < 2) break;
    if (count == known) continue;  // poses are far apart
    known = count;
    const auto past = track.first(known);
    const Twist velocity_O = goes_on_by(past);
    for (const auto& [ahead, of_ahead] :
         {std::pair{kHalf, &misses.half}, {kWhole, &misses.whole}}) {
      const Time then = past.back().stamp + ahead;
      if (then > last) continue;
      const Pose predicted = past.back().T_W_O * Exp(ToSeconds(ahead) * velocity_O);
      of_ahead->Add((predicted * center_O - PoseAt(track, then) * center_O).squaredNorm());
    }
  }
  return misses;
}

// Root mean squares of misses times kOf95 were right for 95 in 100 objects of recorded drives
// (KITTI, Argoverse 2): those at rest drift evenly, of others the error grows with the square of
// the time.
PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O) {
  if (has_motion && velocity_O == Twist{}) {
    constexpr double kOf95 = 2.2, kUsualHalf_m = 0.06, kUsualWhole_m = 0.12;
    const double half_m = kOf95 * misses.half.Scale_m(kUsualHalf_m);
    const double whole_m = kOf95 * misses.whole.Scale_m(kUsualWhole_m);
    const double per_s = std::clamp(2 * (whole_m - half_m), 0.0, whole_m);
    return {whole_m - per_s, per_s, 0};
  }
  constexpr double kOf95 = 2.1, kUsualHalf_m = 0.17, kUsualWhole_m = 0.5;
  constexpr double kGrows = 0.5;  // at least so much of it
  const double usual = has_motion ? ShareOfUsual(velocity_O.linear.norm()) : 1;
  const double half_m = kOf95 * misses.half.Scale_m(usual * kUsualHalf_m);
  const double whole_m = kOf95 * misses.whole.Scale_m(usual * kUsualWhole_m);
  const double per_s2 = std::clamp((whole_m - half_m) / 0.75, kGrows * whole_m, whole_m);
  return {whole_m - per_s2, 0, 2 * per_s2};
}

PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params) {
  const auto by_itself = [&](std::span<const StampedPose> past) {
    const Twist last_motion_O = VelocityBetween(past[past.size() - 2], past.back());
    return GoesOn(past, last_motion_O, solid, params);
  };
  return BoundBy(MissesOf(track, since, solid, by_itself), track.size() > 1, velocity_O);
}

PositionBound BoundAfter(const PositionBound& bound, double seconds) {
  return {bound.At(seconds), bound.speed_mps + bound.accel_mps2 * seconds, bound.accel_mps2};
}

}  // namespace clearway
