// Errors of a SLAM system: correlated over time, with a given mean over a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// The error of one pose over a run: rotation vector and translation are, in each axis, discrete
// Ornstein-Uhlenbeck processes e(k) = rho * e(k-1) + sqrt(1 - rho^2) * N(0, 1) with
// rho = exp(-period / correlation), scaled so that the run's mean angle and mean distance are
// exactly the given ones. A correlation of zero is white noise. A plain value.
struct PoseErrorModel {
  double mean_rotation_rad = 0;
  double mean_translation_m = 0;
  Duration rotation_correlation = Duration::zero();
  Duration translation_correlation = Duration::zero();
  // Starts at no error, as a SLAM system does whose world frame is its first pose: drift. Else it
  // starts in the process' steady state.
  bool starts_at_truth = false;

  bool Zero() const { return mean_rotation_rad == 0 && mean_translation_m == 0; }
  bool operator==(const PoseErrorModel&) const = default;
};

// What a simulated SLAM system gets wrong. A plain value; default: nothing.
struct SlamNoise {
  PoseErrorModel sensor;  // T_W_S as reported = T_W_S * error(k), in S
  // T_W_B as reported = T_W_B * error(k), in B and for each object on its own. Motions as reported
  // lead from one reported pose to the next, so a motion's error, in B, is error(k) *
  // error(k-1)^-1: its mean distance is about sqrt(2 (1 - rho)) times the pose's, likewise its
  // angle.
  PoseErrorModel object;

  // Table I of DynORecon (arXiv 2409.19928), mean errors of a run: camera pose 2.09 deg and 0.29 m,
  // object motion 1.89 deg and 0.54 m, object pose 2.91 deg and 0.57 m, for frames `period` apart.
  // Camera and object pose means are met exactly. The motion errors fix the correlation:
  // (1.89 / 2.91)^2 = 2 (1 - rho) gives rho = 0.789 for the rotation, (0.54 / 0.57)^2 gives
  // rho = 0.551 for the translation, and then the motion errors come out near the table's. (White
  // motion noise of 0.54 m a frame would instead carry the object pose off without bound.) The
  // table does not fix the camera's correlation: its error is drift from the first pose with a
  // correlation of 10 s.
  static SlamNoise TableOne(Duration period = std::chrono::milliseconds(100));

  bool operator==(const SlamNoise&) const = default;
};

// The errors of frames 0 to count - 1, each as the pose by which the truth is multiplied from the
// right. The same arguments give the same bytes on every machine with the same math library.
std::vector<Pose> ErrorsOfRun(const PoseErrorModel& error, std::size_t count, Duration period,
                              std::uint64_t seed, std::uint64_t stream);

}  // namespace clearway
