#include "scene/track_motion.h"

#include <array>
#include <cmath>
#include <vector>

#include "scene/normal_equations.h"
#include "scene/object_motion.h"

namespace clearway {
namespace {

// Older poses say nothing of how the object will go on. What turns changes its mind sooner.
constexpr double kWindow_s = 1.15, kTurnWindow_s = 0.55;
constexpr std::size_t kFewest = 3;  // poses that can be fitted
constexpr double kFading_s = 0.45;  // a pose of that age counts for 1/e
// Half of the time ahead at which a screw comes to where an object that gains speed does.
constexpr double kAim_s = 0.5;
// The variance of poses (0.03 m)^2 over that of accelerations (0.42 m/s^2)^2.
constexpr double kPoseOverAcceleration = 0.005;
// Turns within a window that are longer might be the other way round.
constexpr double kLongestTurn_rad = 1.5;
constexpr double kRounding_mps = 1e-7;  // within 10 m of O

// A pose as the newest one sees it.
struct Sample {
  double at_s;  // 0 for the newest one, before it less
  double weight;
  Eigen::Vector3d turn_O;    // rotation vector
  Eigen::Vector3d center_O;  // from where the centre is
};

// The newest first, at least kShortestStep apart: of sensors that are triggered together, one
// counts.
std::vector<Sample> SamplesOf(std::span<const StampedPose> track, const Eigen::Vector3d& center_O) {
  const StampedPose& last = track.back();
  const Pose T_O_W = Inverse(last.T_W_O);
  std::vector<Sample> samples;
  Time latest = last.stamp;  // that the next may have
  for (std::size_t i = track.size(); i-- > 0;) {
    if (track[i].stamp > latest) continue;
    latest = track[i].stamp - kShortestStep;
    const double at_s = ToSeconds(track[i].stamp - last.stamp);
    const Pose seen = T_O_W * track[i].T_W_O;
    const Eigen::Vector3d turn_O = Log(seen).angular;
    if (at_s < -kWindow_s || turn_O.norm() > kLongestTurn_rad) break;
    samples.push_back({at_s, std::exp(at_s / kFading_s), turn_O, seen * center_O - center_O});
  }
  return samples;
}

// The slope of a weighted straight line through the turns.
Eigen::Vector3d TurnRate(const std::vector<Sample>& samples) {
  double weight = 0, at = 0;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const Sample& sample : samples) {
    if (count >= 2 && sample.at_s < -kTurnWindow_s) break;
    weight += sample.weight;
    at += sample.weight * sample.at_s;
    turn += sample.weight * sample.turn_O;
    ++count;
  }
  at /= weight;
  turn /= weight;
  double spread = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const double off = samples[i].at_s - at;
    spread += samples[i].weight * off * off;
    slope += samples[i].weight * off * (samples[i].turn_O - turn);
  }
  return slope / spread;
}

using LeastSquares = NormalEquations<9>;

// Of the centre, when the screw aims there. Unknown are the centre's place now (the newest pose has
// noise too), its velocity and its acceleration.
Eigen::Vector3d VelocityOfCenter(const std::vector<Sample>& samples,
                                 const Eigen::Vector3d& turn_rate_O, const Eigen::Vector3d& up_O) {
  LeastSquares squares;
  for (const Sample& sample : samples) {
    std::array<LeastSquares::Row, 3> rows{};
    for (int axis = 0; axis < 3; ++axis) {
      // What a velocity of 1 along the axis, turning with the object, has moved it by at that time.
      const Eigen::Vector3d moves =
          Exp(sample.at_s * Twist{turn_rate_O, Eigen::Vector3d::Unit(axis)}).translation;
      rows[axis][axis] = 1;
      for (int to = 0; to < 3; ++to) {
        rows[to][3 + axis] = moves[to];
        rows[to][6 + axis] = 0.5 * sample.at_s * moves[to];
      }
    }
    for (int to = 0; to < 3; ++to) squares.Add(sample.weight, rows[to], sample.center_O[to]);
  }
  constexpr double kNone = 1e3;
  for (int axis = 0; axis < 3; ++axis) {
    LeastSquares::Row small{};
    small[6 + axis] = 1;
    squares.Add(kPoseOverAcceleration, small, 0);
  }
  squares.Add(kNone, {0, 0, 0, 0, 0, 0, up_O.x(), up_O.y(), up_O.z()}, 0);
  const LeastSquares::Row best = squares.Solve();
  const Eigen::Vector3d now(best[3], best[4], best[5]), gained(best[6], best[7], best[8]);
  const Eigen::Vector3d aimed = now + kAim_s * gained;
  return aimed.dot(now) > 0 ? aimed : Eigen::Vector3d::Zero();
}

}  // namespace

Twist VelocityOfTrack(std::span<const StampedPose> track, const Eigen::Vector3d& center_O) {
  const std::vector<Sample> samples = SamplesOf(track, center_O);
  if (samples.size() < kFewest) return LastMotionOf(track);
  const Eigen::Vector3d turn_rate_O = TurnRate(samples);
  const Eigen::Vector3d up_O = track.back().T_W_O.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d center_mps = VelocityOfCenter(samples, turn_rate_O, up_O);
  constexpr double kReach_m = 10;
  if (center_mps.norm() + kReach_m * turn_rate_O.norm() < kRounding_mps) return {};
  return {turn_rate_O, center_mps - turn_rate_O.cross(center_O)};
}

}  // namespace clearway
