// Directions along which convex bodies are apart.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "absl/functional/function_ref.h"

namespace clearway {

// The point of a convex body that is farthest in a direction.
using FarthestPoint = absl::FunctionRef<Eigen::Vector3d(const Eigen::Vector3d& direction)>;

// Along this direction, of length 1, the second body lies at least gap_m beyond the first: a plane
// fits between them if that is positive. A value.
struct Separation {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double gap_m = -std::numeric_limits<double>::infinity();
  double at_most_m = std::numeric_limits<double>::infinity();  // the distance; 0 if both meet
};

// Looks for the direction with the greatest gap, which is the distance if the bodies are apart, and
// stops once a gap is enough or all but as great as can be. Whatever it finds, both bounds hold,
// with 1e-9 m to spare: the gap is measured along the direction, the other between two points.
// (Gilbert, Johnson and Keerthi, "A Fast Procedure for Computing the Distance Between Complex
// Objects in Three-Dimensional Space", 1988; van den Bergen, "Collision Detection in Interactive 3D
// Environments", 2004, section 4.3.)
//
// `first_look` need not have any length but 0. If the distance is at most margin_m the search ends
// when that is known.
Separation FindSeparation(FarthestPoint first, FarthestPoint second,
                          const Eigen::Vector3d& first_look, double margin_m,
                          absl::FunctionRef<bool(const Separation&)> enough);

}  // namespace clearway
