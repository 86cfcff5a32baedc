#include "collision/cube_contact.h"

#include <algorithm>

namespace clearway {

// The shape is convex: it lies beyond the plane through its point q nearest to the cube's centre,
// across the line between the two. So the cube is at least as far as from that plane, and at most
// as far as from q.
CubeContact::Answer CubeContact::Of(const Eigen::Vector3d& center_F, double half_edge_m) const {
  constexpr double kRounding_m = 1e-9;
  const std::optional<Eigen::Vector3d> to_center_F = shape_.FromNearestPoint(center_F);
  if (!to_center_F) return Answer::kOpen;
  const Eigen::Array3d gap = to_center_F->array().abs();
  const double distance_m = to_center_F->norm();
  if (distance_m == 0) return Answer::kYes;
  const double at_least_m = distance_m - half_edge_m * gap.sum() / distance_m;
  if (at_least_m > margin_m_ + kRounding_m) return Answer::kNo;
  const double at_most_m = (gap - half_edge_m).max(0).matrix().norm();
  return at_most_m <= std::max(margin_m_ - kRounding_m, 0.0) ? Answer::kYes : Answer::kOpen;
}

}  // namespace clearway
