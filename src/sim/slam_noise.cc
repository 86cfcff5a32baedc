#include "clearway/sim/slam_noise.h"

#include <cmath>
#include <numbers>

#include "sim/random.h"

namespace clearway {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

double Rho(Duration period, Duration correlation) {
  if (correlation <= Duration::zero()) return 0;
  return std::exp(-ToSeconds(period) / ToSeconds(correlation));
}

Eigen::Vector3d Normal3(Random& random) {
  const double x = random.Normal();
  const double y = random.Normal();
  const double z = random.Normal();
  return {x, y, z};
}

// A process whose norm has the given mean over the run.
std::vector<Eigen::Vector3d> Process(double mean, double rho, bool starts_at_zero,
                                     std::size_t count, Random& random) {
  std::vector<Eigen::Vector3d> errors;
  errors.reserve(count);
  Eigen::Vector3d error = starts_at_zero ? Eigen::Vector3d::Zero().eval() : Normal3(random);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (k > 0) error = rho * error + std::sqrt(1 - rho * rho) * Normal3(random);
    sum += error.norm();
    errors.push_back(error);
  }
  const double scale = sum > 0 ? mean * static_cast<double>(count) / sum : 0;
  for (Eigen::Vector3d& e : errors) e *= scale;
  return errors;
}

// The correlation time of a process whose step from one frame to the next has `ratio` times the
// mean norm of the process itself: ratio^2 = 2 (1 - rho).
Duration CorrelationForStepRatio(double ratio, Duration period) {
  return FromSeconds(-ToSeconds(period) / std::log(1 - 0.5 * ratio * ratio));
}

}  // namespace

SlamNoise SlamNoise::TableOne(Duration period) {
  SlamNoise noise;
  noise.sensor = {.mean_rotation_rad = 2.09 * kRadPerDeg,
                  .mean_translation_m = 0.29,
                  .rotation_correlation = std::chrono::seconds(10),
                  .translation_correlation = std::chrono::seconds(10),
                  .starts_at_truth = true};
  noise.object = {.mean_rotation_rad = 2.91 * kRadPerDeg,
                  .mean_translation_m = 0.57,
                  .rotation_correlation = CorrelationForStepRatio(1.89 / 2.91, period),
                  .translation_correlation = CorrelationForStepRatio(0.54 / 0.57, period),
                  .starts_at_truth = false};
  return noise;
}

std::vector<Pose> ErrorsOfRun(const PoseErrorModel& error, std::size_t count, Duration period,
                              std::uint64_t seed, std::uint64_t stream) {
  if (error.Zero()) return std::vector<Pose>(count);
  Random rotation_random(seed, stream, 0);
  Random translation_random(seed, stream, 1);
  const auto rotations = Process(error.mean_rotation_rad, Rho(period, error.rotation_correlation),
                                 error.starts_at_truth, count, rotation_random);
  const auto translations =
      Process(error.mean_translation_m, Rho(period, error.translation_correlation),
              error.starts_at_truth, count, translation_random);
  std::vector<Pose> errors;
  errors.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    errors.push_back({Exp({rotations[k], Eigen::Vector3d::Zero()}).rotation, translations[k]});
  }
  return errors;
}

}  // namespace clearway
