// Where points fit the surface of a map: point to distribution, robust, from coarse to fine.
#pragma once

#include <limits>
#include <span>

#include "clearway/geometry/pose.h"
#include "scene/surface_cells.h"

namespace clearway {

// The frame Q is the one that points are given in (of a view of an object: the world; of a scan:
// the sensor), and M the one that the cells of the map are given in.

// A guess of T_Q_M, and how far it may be off (standard deviation along and about each axis of Q).
struct PoseGuess {
  PoseGuess(const Pose& pose, const Eigen::Vector3d& along_m, const Eigen::Vector3d& about_rad)
      : T_Q_M(pose), sigma_m(along_m), sigma_rad(about_rad) {}
  // The same for all axes.
  PoseGuess(const Pose& pose, double along_m, double about_rad)
      : PoseGuess(pose, Eigen::Vector3d::Constant(along_m), Eigen::Vector3d::Constant(about_rad)) {}

  Pose T_Q_M;
  Eigen::Vector3d sigma_m, sigma_rad;
};

// Steps of Gauss and Newton over cells of one size. What is farther than `scale` deviations from
// the surface hardly counts.
struct RegistrationStage {
  SurfaceCells& cells;
  double scale;
  int steps;
};

struct RegistrationWeights {
  // How much a point tells. Points near each other are wrong in the same way: each tells less than
  // if it were alone.
  double trust;
  // Steps end with one that is shorter: metres and radians together.
  double least_step;
  // A guess that is off by more deviations is likely wrong, and counts less the more it is.
  double guess_sigmas = std::numeric_limits<double>::infinity();
};

// Registers points to a map. Both spans must outlive it. One thread.
class Registration {
 public:
  Registration(std::span<const Eigen::Vector3d> points_Q, std::span<const PoseGuess> guesses,
               const RegistrationWeights& weights)
      : points_Q_(points_Q), guesses_(guesses), weights_(weights) {}

  // The T_Q_M that fits best, of all stages in turn (at least one), from the guess (at least one)
  // that fits best. Guesses count as measurements beside the points.
  Pose Register(std::span<const RegistrationStage> stages) const;

 private:
  Pose BestGuess(const RegistrationStage& stage) const;
  Pose Refine(Pose T_Q_M, const RegistrationStage& stage) const;
  // What the steps make small.
  double Cost(const Pose& T_Q_M, const RegistrationStage& stage) const;
  Twist Step(const Pose& T_Q_M, const RegistrationStage& stage) const;

  std::span<const Eigen::Vector3d> points_Q_;
  std::span<const PoseGuess> guesses_;
  RegistrationWeights weights_;
};

}  // namespace clearway
