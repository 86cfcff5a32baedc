// Random input for tests: the same sequence on every run.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

#include "clearway/geometry/pose.h"

namespace clearway::testing_support {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double Uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() - engine_.min()) /
                                 static_cast<double>(engine_.max() - engine_.min()));
  }
  // In [low, high].
  int Integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<unsigned>(high - low + 1));
  }
  // Of variance 1 (Box and Muller).
  double Normal() {
    const double u = Uniform(1e-12, 1), v = Uniform(0, 2 * std::numbers::pi);
    return std::sqrt(-2 * std::log(u)) * std::cos(v);
  }
  Eigen::Vector3d Vector(double half_extent) {
    const double x = Uniform(-half_extent, half_extent), y = Uniform(-half_extent, half_extent);
    return {x, y, Uniform(-half_extent, half_extent)};
  }
  Eigen::Vector3d UnitVector() {
    Eigen::Vector3d v = Vector(1);
    while (v.norm() < 0.1 || v.norm() > 1) v = Vector(1);
    return v.normalized();
  }
  Pose AnyPose(double half_extent_m) {
    const double angle = Uniform(0, std::numbers::pi);
    return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, UnitVector())), Vector(half_extent_m)};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace clearway::testing_support
