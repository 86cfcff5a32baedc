#include "collision/cube_contact.h"

#include <algorithm>

namespace clearway {

CubeContact::CubeContact(const PlacedShape& shape, double margin_m)
    : shape_(shape), core_(shape.AsRoundedBox()) {
  const double reach_m = margin_m + (core_ ? core_->radius_m : 0);
  near_m_ = std::max(reach_m - kRounding_m, 0.0);
  far_m_ = reach_m + kRounding_m;
}

// The core is convex: it lies beyond the plane through its point q nearest to the cube's centre,
// across the line between the two. So the cube is at least as far as from that plane, and at most
// as far as from q.
CubeContact::Answer CubeContact::Between(const Eigen::Vector3d& to_center_F,
                                         double half_edge_m) const {
  const Eigen::Array3d gap = to_center_F.array().abs();
  const double distance_m = to_center_F.norm();
  if (distance_m == 0) return Answer::kYes;
  if (distance_m - half_edge_m * gap.sum() / distance_m > far_m_) return Answer::kNo;
  const double at_most_m = (gap - half_edge_m).max(0).matrix().norm();
  return at_most_m <= near_m_ ? Answer::kYes : Answer::kOpen;
}

CubeContact::Answer CubeContact::OfAnyShape(const Eigen::Vector3d& center_F,
                                            double half_edge_m) const {
  const std::optional<Eigen::Vector3d> to_center_F = shape_.FromNearestPoint(center_F);
  return to_center_F ? Between(*to_center_F, half_edge_m) : Answer::kOpen;
}

}  // namespace clearway
