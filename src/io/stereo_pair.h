// Two cameras side by side, and what they see.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// Pinholes without lens distortion; S is the frame that both project from, z forward. A value; any
// thread.
class StereoPair {
 public:
  using Projection = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

  // pixel ~ left * p_S, pixel ~ right * p_S. INVALID_ARGUMENT, beginning with `where`, for what is
  // no such camera, and if both are at one place.
  static absl::StatusOr<StereoPair> Make(const Projection& left, const Projection& right,
                                         const std::string& where);

  // The point seen there by the left and by the right camera, by least squares; none if it is
  // behind them, or so far that they see it less than a pixel apart.
  std::optional<Eigen::Vector3d> Triangulate(const Eigen::Vector2d& left,
                                             const Eigen::Vector2d& right) const;
  // Where the left camera sees a point; none if it is not before it.
  std::optional<Eigen::Vector2d> ProjectLeft(const Eigen::Vector3d& p_S) const;

 private:
  Projection left_, right_;
  double farthest_m_ = 0;
};

}  // namespace clearway
