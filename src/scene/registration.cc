#include "scene/registration.h"

#include <cmath>
#include <limits>

#include "scene/normal_equations.h"

namespace clearway {
namespace {

using Equations = NormalEquations<6>;  // of a Twist in M: linear, then angular

double WeightOf(const Eigen::Vector3d& p_M, const SurfaceCells::Cell& cell, double scale) {
  double square = 0;
  for (int i = 0; i < 3; ++i) square += cell.Deviation(p_M, i) * cell.Deviation(p_M, i);
  return std::exp(-0.5 * square / (scale * scale));
}

// A twist (v, w) of M moves the point in it by -v - w x p.
void AddPoint(const Eigen::Vector3d& p_M, const SurfaceCells::Cell& cell, double weight,
              Equations& equations) {
  constexpr double kNone = 1e-6;
  if (weight < kNone) return;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = cell.factors[i];
    const Eigen::Vector3d turned = a.cross(p_M);  // -a (w x p) = w (a x p)
    equations.Add(weight, {-a.x(), -a.y(), -a.z(), turned.x(), turned.y(), turned.z()},
                  -cell.Deviation(p_M, i));
  }
}

// Of how many deviations T_Q_M is off from the guess.
double SquareOff(const Twist& off, const PoseGuess& guess) {
  const Eigen::Quaterniond& R_Q_M = guess.T_Q_M.rotation;
  return (R_Q_M * off.linear).cwiseQuotient(guess.sigma_m).squaredNorm() +
         (R_Q_M * off.angular).cwiseQuotient(guess.sigma_rad).squaredNorm();
}

// Cauchy's: like the square near zero, and hardly growing beyond `sigmas`.
double RobustSquare(double square, double sigmas) {
  if (std::isinf(sigmas)) return square;
  return sigmas * sigmas * std::log(1 + square / (sigmas * sigmas));
}

void AddGuess(const Pose& T_Q_M, const PoseGuess& guess, double sigmas, Equations& equations) {
  const Twist off = Log(Inverse(guess.T_Q_M) * T_Q_M);
  const double weight = 1 / (1 + SquareOff(off, guess) / (sigmas * sigmas));
  const Eigen::Matrix3d R_Q_M = guess.T_Q_M.rotation.toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d a = R_Q_M.row(axis);  // Q's axis in M
    const double m = guess.sigma_m[axis], rad = guess.sigma_rad[axis];
    equations.Add(weight / (m * m), {a.x(), a.y(), a.z(), 0, 0, 0}, -a.dot(off.linear));
    equations.Add(weight / (rad * rad), {0, 0, 0, a.x(), a.y(), a.z()}, -a.dot(off.angular));
  }
}

}  // namespace

Pose Registration::Register(std::span<const RegistrationStage> stages) const {
  Pose T_Q_M = BestGuess(stages.front());
  for (const RegistrationStage& stage : stages) T_Q_M = Refine(T_Q_M, stage);
  return T_Q_M;
}

Pose Registration::BestGuess(const RegistrationStage& stage) const {
  Pose T_Q_M = guesses_.front().T_Q_M;
  double least = std::numeric_limits<double>::infinity();
  for (const PoseGuess& guess : guesses_) {
    const double cost = Cost(guess.T_Q_M, stage);
    if (cost >= least) continue;
    least = cost;
    T_Q_M = guess.T_Q_M;
  }
  return T_Q_M;
}

Pose Registration::Refine(Pose T_Q_M, const RegistrationStage& stage) const {
  for (int step = 0; step < stage.steps; ++step) {
    const Twist twist = Step(T_Q_M, stage);
    T_Q_M = T_Q_M * Exp(twist);
    if (twist.linear.norm() + twist.angular.norm() < weights_.least_step) break;
  }
  return T_Q_M;
}

double Registration::Cost(const Pose& T_Q_M, const RegistrationStage& stage) const {
  const Pose T_M_Q = Inverse(T_Q_M);
  double fit = 0;
  for (const Eigen::Vector3d& p_Q : points_Q_) {
    const Eigen::Vector3d p_M = T_M_Q * p_Q;
    const SurfaceCells::Cell* cell = stage.cells.At(p_M);
    if (cell != nullptr) fit += WeightOf(p_M, *cell, stage.scale);
  }
  double cost = -weights_.trust * stage.scale * stage.scale * fit;
  for (const PoseGuess& guess : guesses_) {
    const Twist off = Log(Inverse(guess.T_Q_M) * T_Q_M);
    cost += 0.5 * RobustSquare(SquareOff(off, guess), weights_.guess_sigmas);
  }
  return cost;
}

Twist Registration::Step(const Pose& T_Q_M, const RegistrationStage& stage) const {
  const Pose T_M_Q = Inverse(T_Q_M);
  Equations equations;
  for (const Eigen::Vector3d& p_Q : points_Q_) {
    const Eigen::Vector3d p_M = T_M_Q * p_Q;
    const SurfaceCells::Cell* cell = stage.cells.At(p_M);
    if (cell == nullptr) continue;
    AddPoint(p_M, *cell, weights_.trust * WeightOf(p_M, *cell, stage.scale), equations);
  }
  for (const PoseGuess& guess : guesses_) {
    AddGuess(T_Q_M, guess, weights_.guess_sigmas, equations);
  }
  const Equations::Row row = equations.Solve();
  return {{row[3], row[4], row[5]}, {row[0], row[1], row[2]}};
}

}  // namespace clearway
