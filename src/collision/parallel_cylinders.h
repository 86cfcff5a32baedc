// Cylinders side by side, which need no search for what parts them.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"

namespace clearway {

// Two cylinders whose axes are parallel: people, posts and round robots on level ground. As seen
// from the second, whose axis is z. A value.
class ParallelCylinders {
 public:
  // None if the axes are not parallel (up to 1e-12 rad).
  static std::optional<ParallelCylinders> Of(const Cylinder& first, const Cylinder& second,
                                             const Pose& T_second_first);

  double Distance() const;  // 0 where they meet

  // As the first goes on by `way`: before which share, up to `until`, they are farther than
  // margin_m from each other; kNever if that is so up to there. None where the rims meet first,
  // which has no closed form, and for what is not a number.
  std::optional<double> FirstTouch(const Eigen::Vector3d& way, double margin_m, double until) const;

 private:
  ParallelCylinders() = default;

  Eigen::Vector3d to_first_m_;  // from centre to centre
  double radii_m_, halves_m_;   // of both together
};

}  // namespace clearway
