#include "scene/position_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/object_motion.h"

namespace clearway {
namespace {

// Velocities that are fitted to many poses are as if of two that far apart; white noise would
// even out better, but that of recorded boxes lasts.
constexpr double kFitted_s = 0.1;
constexpr double kShortest_s = 0.02;
constexpr double kFast_mps = 2.5;
constexpr double kMaxCentripetal_mps2 = 10;
constexpr double kNear_s = 0.5, kAll_s = std::numeric_limits<double>::infinity();

// What is usual, before the object's own misses count.
PositionBound Scaled(const PositionBound& bound, double by) {
  return {by * bound.at_m, by * bound.speed_mps, by * bound.accel_mps2};
}

double Jitter_m(const PastMisses& misses, const BoundModel& model) {
  if (misses.jitter_count == 0) return model.unknown_jitter_m;
  return std::sqrt(misses.jitter_m2 / (1 + misses.jitter_count));
}

double Accel_mps2(const PastMisses& misses, const Twist& velocity_O, const BoundModel& model) {
  const Eigen::Vector3d center_mps = velocity_O.linear + velocity_O.angular.cross(misses.center_O);
  const double speed_mps = center_mps.norm();
  const double centripetal_mps2 =
      std::min(speed_mps * velocity_O.angular.norm(), kMaxCentripetal_mps2);
  return model.rest_accel_mps2 + model.speed_accel_mps2 * std::min(1.0, speed_mps / kFast_mps) +
         model.turn_gain * centripetal_mps2;
}

// e(h) = n(h) + c(h).
struct Expected {
  PositionBound noise, choice;

  double At(double ahead_s) const { return noise.At(ahead_s) + choice.At(ahead_s); }
};

Expected ExpectedOf(const PastMisses& misses, const Twist& velocity_O, bool of_last_motion,
                    const BoundModel& model) {
  const double jitter_m = Jitter_m(misses, model);
  const double given_s = misses.interval_s > 0 ? misses.interval_s : kFitted_s;
  const double interval_s = std::clamp(given_s, of_last_motion ? kShortest_s : kFitted_s, 1.0);
  const double accel_mps2 = Accel_mps2(misses, velocity_O, model);
  return {{model.jitter_gain * jitter_m, model.jitter_rate_gain * jitter_m / interval_s, 0},
          {0, model.response_s * accel_mps2, accel_mps2}};
}

// q or p, by the misses up to that long ahead.
double Unpredictability(const PastMisses& misses, const Expected& expected, double prior_count,
                        double up_to_s, const BoundModel& model) {
  constexpr double kRounding_m2 = 1e-8;
  double count = prior_count, sum = prior_count;
  const auto add = [&](const Misses& of, double weight) {
    if (of.ahead_s > up_to_s) return;
    const double expected_m = expected.At(of.ahead_s);
    count += weight * of.count;
    sum += weight * of.sum_m2 / (expected_m * expected_m + kRounding_m2);
  };
  for (const Misses& soon : misses.soon) add(soon, model.soon_weight);
  for (const Misses& late : misses.late) add(late, model.late_weight);
  return std::sqrt(sum / count);
}

PositionBound Sum(const PositionBound& a, const PositionBound& b) {
  return {a.at_m + b.at_m, a.speed_mps + b.speed_mps, a.accel_mps2 + b.accel_mps2};
}

PositionBound BoundInMotion(const PastMisses& misses, const Expected& expected,
                            const BoundModel& model) {
  const double q = Unpredictability(misses, expected, model.prior_count, kAll_s, model);
  const double near = Unpredictability(misses, expected, model.near_prior_count, kNear_s, model);
  return Sum(Scaled(expected.noise, model.factor * std::max(q, near)),
             Scaled(expected.choice, model.factor * q));
}

PositionBound BoundAtRest(const PastMisses& misses, const BoundModel& model) {
  const Expected expected{
      {model.rest_jitter_gain * Jitter_m(misses, model), model.rest_drift_mps, 0}, {}};
  const double q = Unpredictability(misses, expected, model.rest_prior_count, kAll_s, model);
  return Scaled(expected.noise, model.rest_factor * q);
}

}  // namespace

PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O,
                      bool of_last_motion, const BoundModel& model) {
  if (!(velocity_O == Twist{})) {
    return BoundInMotion(misses, ExpectedOf(misses, velocity_O, of_last_motion, model), model);
  }
  return has_motion ? BoundAtRest(misses, model) : PositionBound{0, model.unknown_mps, 0};
}

PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params) {
  const auto by_itself = [&](std::span<const StampedPose> past) {
    return GoesOnByItself(past, solid, params);
  };
  return BoundBy(MissesOf(track, since, solid, by_itself), track.size() > 1, velocity_O,
                 params.motion == MotionModel::kLastMotion);
}

PositionBound BoundAfter(const PositionBound& bound, double seconds) {
  return {bound.At(seconds), bound.speed_mps + bound.accel_mps2 * seconds, bound.accel_mps2};
}

}  // namespace clearway
