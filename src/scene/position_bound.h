// The 95 % bound on a predicted position's error.
#pragma once

#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"
#include "scene/past_misses.h"

namespace clearway {

// The model of the bound. Of an object that moves, a prediction for h seconds ahead is expected to
// be off by about e(h) = n(h) + c(h). The noise of its poses makes
//
//   n(h) = jitter_gain J + (jitter_rate_gain J / D) h,
//
// and what it may choose to do makes
//
//   c(h) = response_s a h + a h^2 / 2.
//
// J is the noise of its poses (unknown_jitter_m until three of them are known), D the time between
// the poses that the velocity comes from, and a the acceleration that an object of its speed v and
// turn rate w may choose: from rest_accel_mps2 up by speed_accel_mps2 at kFast_mps, and turn_gain
// times the centripetal acceleration v w. Of an object at rest e(h) is rest_jitter_gain J +
// rest_drift_mps h.
//
// The bound is factor (p n(h) + q c(h)), at rest factor q e(h). q tells how predictable this object
// is: q^2 is the mean of m^2 / e(h)^2 over its own past predictions, which missed by m, and of
// prior_count times 1. So the bound is calibrated in the way of conformal prediction: by the errors
// of the same predictor on the same object. p is the same for predictions of up to half a second
// alone, with near_prior_count, and at least q: later misses, small beside c(h), would hide that
// the poses are noisier than J tells.
//
// All numbers but rest_accel_mps2 were fitted by quantile regression (R. Koenker, G. Bassett,
// "Regression Quantiles", Econometrica 46, 1978) to recordings of road users;
// benchmarks/bound_bench does that again, and shows how far the bounds hold on recordings that were
// left out. rest_accel_mps2 is set by hand: only one recording has slow objects with smooth tracks,
// so a fit without it would trust them blindly.
struct BoundModel {
  double factor = 1.69;
  double prior_count = 13.8, near_prior_count = 7.5;
  double late_weight = 3.7, soon_weight = 0.53;  // of one past prediction (PastMisses)

  double unknown_jitter_m = 0.036;
  double jitter_gain = 0.34, jitter_rate_gain = 0.38;
  double response_s = 0.67;
  double rest_accel_mps2 = 0.05, speed_accel_mps2 = 1.4, turn_gain = 0.39;

  double rest_factor = 0.92;
  double rest_prior_count = 0.34;
  double rest_jitter_gain = 12.3, rest_drift_mps = 4.0;

  // Speed of an object of which one pose is known and no motion.
  double unknown_mps = 15.5;
};

// The bound of an object of that velocity and past. `has_motion`: more than one of its poses is
// known. `of_last_motion`: the velocity is that between the last two poses, not fitted to more.
PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O,
                      bool of_last_motion, const BoundModel& model = {});

// The bound of an object of that track, the last pose of which is the newest, that is predicted
// with that velocity. Poses before `since` do not count.
PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params);

// The bound as seen from a prediction that long ahead, which is taken for a pose.
PositionBound BoundAfter(const PositionBound& bound, double seconds);

}  // namespace clearway
