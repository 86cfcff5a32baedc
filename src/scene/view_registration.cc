#include "scene/view_registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/normal_equations.h"
#include "scene/surface_cells.h"

namespace clearway {
namespace {

using Equations = NormalEquations<6>;  // of a Twist in O: linear, then angular

// Points near each other are wrong in the same way: each tells less than if it were alone.
constexpr double kTrust = 0.2;
constexpr std::size_t kMostPoints = 128;
constexpr int kCoarseBits = 3, kFineBits = 2;  // of the cells

// Steps of Gauss and Newton over cells of one size. What is farther than `scale` deviations from
// the surface hardly counts.
struct Stage {
  SurfaceCells& cells;
  double scale;
  int steps;
};

class Registration {
 public:
  Registration(std::span<const Eigen::Vector3d> points_W, std::span<const PoseGuess> guesses)
      : points_W_(points_W), guesses_(guesses) {}

  Pose Refine(Pose T_W_O, const Stage& stage) const {
    constexpr double kSmall = 5e-3;
    for (int step = 0; step < stage.steps; ++step) {
      const Equations::Row row = Solve(T_W_O, stage);
      const Twist twist{{row[3], row[4], row[5]}, {row[0], row[1], row[2]}};
      T_W_O = T_W_O * Exp(twist);
      if (twist.linear.norm() + twist.angular.norm() < kSmall) break;
    }
    return T_W_O;
  }

  // What the steps make small.
  double Cost(const Pose& T_W_O, const Stage& stage) const {
    const Pose T_O_W = Inverse(T_W_O);
    double fit = 0;
    for (const Eigen::Vector3d& p_W : points_W_) {
      const Eigen::Vector3d p_O = T_O_W * p_W;
      const SurfaceCells::Cell* cell = stage.cells.At(p_O);
      if (cell != nullptr) fit += WeightOf(p_O, *cell, stage.scale);
    }
    double cost = -kTrust * stage.scale * stage.scale * fit;
    for (const PoseGuess& guess : guesses_) {
      const Twist off = Log(Inverse(guess.T_W_O) * T_W_O);
      const double metres = off.linear.norm() / guess.sigma_m;
      const double radians = off.angular.norm() / guess.sigma_rad;
      cost += 0.5 * (metres * metres + radians * radians);
    }
    return cost;
  }

 private:
  static double WeightOf(const Eigen::Vector3d& p_O, const SurfaceCells::Cell& cell, double scale) {
    double square = 0;
    for (int i = 0; i < 3; ++i) square += cell.Deviation(p_O, i) * cell.Deviation(p_O, i);
    return std::exp(-0.5 * square / (scale * scale));
  }

  Equations::Row Solve(const Pose& T_W_O, const Stage& stage) const {
    const Pose T_O_W = Inverse(T_W_O);
    Equations equations;
    for (const Eigen::Vector3d& p_W : points_W_) {
      const Eigen::Vector3d p_O = T_O_W * p_W;
      const SurfaceCells::Cell* cell = stage.cells.At(p_O);
      if (cell != nullptr) AddPoint(p_O, *cell, stage.scale, equations);
    }
    for (const PoseGuess& guess : guesses_) AddGuess(T_W_O, guess, equations);
    return equations.Solve();
  }

  // A twist (v, w) of the object moves the point in it by -v - w x p.
  static void AddPoint(const Eigen::Vector3d& p_O, const SurfaceCells::Cell& cell, double scale,
                       Equations& equations) {
    constexpr double kNone = 1e-6;
    const double weight = kTrust * WeightOf(p_O, cell, scale);
    if (weight < kNone) return;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = cell.factors[i];
      const Eigen::Vector3d turned = a.cross(p_O);  // -a (w x p) = w (a x p)
      equations.Add(weight, {-a.x(), -a.y(), -a.z(), turned.x(), turned.y(), turned.z()},
                    -cell.Deviation(p_O, i));
    }
  }

  static void AddGuess(const Pose& T_W_O, const PoseGuess& guess, Equations& equations) {
    const Twist off = Log(Inverse(guess.T_W_O) * T_W_O);
    for (int axis = 0; axis < 3; ++axis) {
      Equations::Row linear{}, angular{};
      linear[axis] = angular[3 + axis] = 1;
      equations.Add(1 / (guess.sigma_m * guess.sigma_m), linear, -off.linear[axis]);
      equations.Add(1 / (guess.sigma_rad * guess.sigma_rad), angular, -off.angular[axis]);
    }
  }

  std::span<const Eigen::Vector3d> points_W_;
  std::span<const PoseGuess> guesses_;
};

std::vector<Eigen::Vector3d> AFew(std::span<const Eigen::Vector3d> points_W) {
  const std::size_t step = std::max<std::size_t>(1, (points_W.size() - 1) / kMostPoints + 1);
  std::vector<Eigen::Vector3d> few;
  for (std::size_t i = 0; i < points_W.size(); i += step) few.push_back(points_W[i]);
  return few;
}

}  // namespace

Pose RegisterView(const VoxelMap& map_O, std::span<const Eigen::Vector3d> points_W,
                  std::span<const PoseGuess> guesses) {
  SurfaceCells coarse(map_O, kCoarseBits), fine(map_O, kFineBits);
  const Stage stages[] = {{coarse, 3, 6}, {coarse, 1.5, 4}, {fine, 2, 8}};
  const std::vector<Eigen::Vector3d> few = AFew(points_W);
  const Registration registration(few, guesses);
  Pose T_W_O = guesses.front().T_W_O;
  double least = std::numeric_limits<double>::infinity();
  for (const PoseGuess& guess : guesses) {
    const double cost = registration.Cost(guess.T_W_O, stages[0]);
    if (cost >= least) continue;
    least = cost;
    T_W_O = guess.T_W_O;
  }
  for (const Stage& stage : stages) T_W_O = registration.Refine(T_W_O, stage);
  return T_W_O;
}

}  // namespace clearway
