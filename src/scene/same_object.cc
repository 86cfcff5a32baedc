#include "scene/same_object.h"

#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

Eigen::Vector3d VelocityOfCenter_mps(const MovingObject& object, const Pose& T_W_O) {
  const Twist& twist_O = *object.velocity_O;
  const Eigen::Vector3d center_O = object.observed_box_O.Center();
  return T_W_O.rotation * (twist_O.linear + twist_O.angular.cross(center_O));
}

Eigen::Vector3d SeenSize_m(const MovingObject& object) {
  return object.observed_box_O.max - object.observed_box_O.min;
}

// Along the way it goes, across it, and its height.
struct Lengths_m {
  double along, across, up;
};

// None of what was seen too briefly, nor of what stands still or does not go along its O's x or y:
// its box lies askew then, for all that is known, and what is seen of it from one side looks as if
// it were small both ways.
std::optional<Lengths_m> LengthsOf(const MovingObject& object) {
  constexpr std::int64_t kFewestFrames = 3, kFewestVoxels = 20;
  constexpr double kGoes_mps = 0.5, kAskew = 0.34;  // 20 degrees
  if (object.frames_seen < kFewestFrames || object.map_O.occupied_count() < kFewestVoxels ||
      !object.velocity_O || object.velocity_O->linear.norm() < kGoes_mps) {
    return std::nullopt;
  }
  const Eigen::Vector3d way_O = object.velocity_O->linear.normalized();
  const int along = std::abs(way_O.x()) >= std::abs(way_O.y()) ? 0 : 1;
  if (std::hypot(way_O[1 - along], way_O.z()) > kAskew) return std::nullopt;
  const Eigen::Array3d size_m = SeenSize_m(object).array() + object.map_O.grid().resolution_m();
  return Lengths_m{size_m[along], size_m[1 - along], size_m.z()};
}

// In two of three, as a view from one side tells no more, and of those by half, as it may show half
// of them: no rival is ruled out by what a match is let pass with (see SeenAgain). Of what is seen
// from an end alone, and so looks broad, nobody knows how long it is.
bool AreAsLarge(const MovingObject& lost, const MovingObject& seen) {
  constexpr double kAlike = 0.5, kBroad = 2;
  const auto a = LengthsOf(lost), b = LengthsOf(seen);
  if (!a || !b) return true;
  const auto alike = [](double x, double y) { return std::min(x, y) >= kAlike * std::max(x, y); };
  const auto broad = [](const Lengths_m& l) { return l.across > kBroad * l.along; };
  return (broad(*a) || broad(*b) || alike(a->along, b->along)) + alike(a->across, b->across) +
             alike(a->up, b->up) >=
         2;
}

// Where it was first seen: over the first second, however it goes by now.
std::optional<Eigen::Vector3d> VelocityAtFirst_mps(const MovingObject& seen) {
  constexpr Duration kOver = std::chrono::seconds(1);
  const StampedPose& first = FirstPose(seen);
  const auto later = std::ranges::find_if(
      seen.history, [&](const StampedPose& pose) { return pose.stamp >= first.stamp + kOver; });
  const auto now_mps = VelocityNow_mps(seen);
  if (!now_mps || later == seen.history.end()) return now_mps;
  const Eigen::Vector3d center_O = seen.observed_box_O.Center();
  return (later->T_W_O * center_O - first.T_W_O * center_O) / ToSeconds(later->stamp - first.stamp);
}

double DistanceToSegment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * along).norm();
}

// How long `lost` was out of sight before `seen` was seen, how that one went at first, and how fast
// the faster of both goes.
struct Absence {
  Absence(const MovingObject& lost, const MovingObject& seen)
      : unseen_s(ToSeconds(FirstPose(seen).stamp - lost.t_k())),
        seen_mps(VelocityAtFirst_mps(seen)),
        speed_mps(std::max(lost.SpeedMps(), seen_mps ? seen_mps->norm() : 0.0)) {}

  double unseen_s;
  std::optional<Eigen::Vector3d> seen_mps;
  double speed_mps;
};

// From where it is predicted to where it would be had it gone as `seen` does.
struct Places {
  Eigen::Vector3d predicted_W, gone_otherwise_W;
};

Places PlacesOf(const MovingObject& lost, const Pose& T_W_L, const Absence& absence) {
  const Eigen::Vector3d center_O = lost.observed_box_O.Center();
  const Eigen::Vector3d predicted_W = T_W_L * center_O;
  if (!absence.seen_mps) return {predicted_W, predicted_W};
  const Eigen::Vector3d gone_W =
      lost.history.back().T_W_O * center_O + absence.unseen_s * *absence.seen_mps;
  return {lost.velocity_O ? predicted_W : gone_W, gone_W};
}

// How far `seen` may be from where `lost` was to be, if it is that one.
double MayBeOff_m(const MovingObject& lost, const MovingObject& seen, const Absence& absence,
                  const SceneParams& params) {
  // Of what was seen in part, the centre is another.
  const double center_m = std::abs(SeenSize_m(lost).norm() - SeenSize_m(seen).norm()) / 2;
  const double told_m = params.object_pose_error_m * std::max(1.0, absence.unseen_s);
  return ToleranceOfPlace_m(lost, absence.speed_mps, absence.unseen_s) + center_m + told_m;
}

}  // namespace

const StampedPose& FirstPose(const MovingObject& object) {
  return *std::find_if(object.history.begin(), object.history.end() - 1,
                       [&](const StampedPose& p) { return p.stamp >= object.tracked_since; });
}

std::optional<Eigen::Vector3d> VelocityNow_mps(const MovingObject& seen) {
  constexpr std::size_t kFewestPoses = 3;
  if (!seen.velocity_O || seen.history.size() < kFewestPoses) return std::nullopt;
  return VelocityOfCenter_mps(seen, seen.history.back().T_W_O);
}

std::optional<Eigen::Vector3d> VelocityAt_mps(const MovingObject& lost, const Pose& T_W_L) {
  if (!lost.velocity_O) return std::nullopt;
  return VelocityOfCenter_mps(lost, T_W_L);
}

bool MayComeToGo(const Eigen::Vector3d& before_mps, const Eigen::Vector3d& now_mps,
                 double unseen_s) {
  constexpr double kAlways_mps = 0.5, kOfSpeed = 0.3, kOfSpeedPer_s = 0.06, kMostOfSpeed = 0.6;
  const double of_speed = std::min(kOfSpeed + kOfSpeedPer_s * unseen_s, kMostOfSpeed);
  return (now_mps - before_mps).norm() <= kAlways_mps + of_speed * before_mps.norm();
}

double ToleranceOfPlace_m(const MovingObject& lost, double speed_mps, double unseen_s) {
  constexpr double kOfWidth = 0.5, kOfWay = 0.1;
  const Eigen::Vector3d size_m = SeenSize_m(lost);
  return kOfWidth * std::min(size_m.x(), size_m.y()) + kOfWay * speed_mps * unseen_s;
}

bool WasLostBefore(const MovingObject& lost, const MovingObject& seen) {
  return !lost.given() && !seen.given() && lost.t_k() < seen.first_seen;
}

std::optional<double> DistanceIfSame_m(const MovingObject& lost, const MovingObject& seen,
                                       const SceneParams& params) {
  if (!WasLostBefore(lost, seen) || !AreAsLarge(lost, seen)) return std::nullopt;
  const StampedPose& first = FirstPose(seen);
  const Absence absence(lost, seen);
  const Pose T_W_L = PredictPose(lost, first.stamp, Duration::max()).T_W_O;
  const auto lost_mps = VelocityAt_mps(lost, T_W_L);
  if (lost_mps && absence.seen_mps &&
      !MayComeToGo(*lost_mps, *absence.seen_mps, absence.unseen_s)) {
    return std::nullopt;
  }

  const Places places = PlacesOf(lost, T_W_L, absence);
  const Eigen::Vector3d there_W = first.T_W_O * seen.observed_box_O.Center();
  if (DistanceToSegment(there_W, places.predicted_W, places.gone_otherwise_W) >
      MayBeOff_m(lost, seen, absence, params)) {
    return std::nullopt;
  }
  return (there_W - places.predicted_W).norm();
}

std::optional<double> LogLikelihoodIfSame(const MovingObject& lost, const MovingObject& seen,
                                          const SceneParams& params) {
  const auto off_m = DistanceIfSame_m(lost, seen, params);
  if (!off_m) return std::nullopt;
  const Absence absence(lost, seen);
  double sigma_m = MayBeOff_m(lost, seen, absence, params);
  if (!VelocityNow_mps(lost)) sigma_m += absence.speed_mps * absence.unseen_s;
  sigma_m = std::max(sigma_m, params.object_resolution_m);
  const double off = *off_m / sigma_m;
  return -off * off / 2 - 2 * std::log(sigma_m);
}

}  // namespace clearway
