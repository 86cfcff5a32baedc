#include "collision/cube_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clearway/geometry/distance.h"
#include "collision/prepared_mesh.h"
#include "collision/touching.h"

namespace clearway {

CubeContact::CubeContact(const PlacedShape& shape, double margin_m)
    : shape_(shape), line_(shape.AsRoundedLine()), box_(shape.AsBox()), mesh_(shape.AsMesh()) {
  radius_m_ = line_ ? line_->radius_m : 0;
  const double reach_m = margin_m + radius_m_;
  sharp_ = reach_m <= kContact_m;
  near_m_ = std::max(reach_m - kRounding_m, 0.0);
  far_m_ = reach_m + kRounding_m;
}

// The line or the shape is convex: it lies beyond the plane through its point q nearest to the
// cube's centre, across the way between the two. So the cube is at least as far as from that plane,
// and at most as far as from q.
CubeContact::Bounds CubeContact::FromCore(const Eigen::Vector3d& to_center_F, double half_edge_m) {
  const Eigen::Array3d gap = to_center_F.array().abs();
  const double distance_m = to_center_F.norm();
  if (distance_m == 0) return {0, 0};
  return {distance_m - half_edge_m * gap.sum() / distance_m,
          (gap - half_edge_m).max(0).matrix().norm()};
}

CubeContact::Answer CubeContact::OfOther(const Eigen::Vector3d& center_F,
                                         double half_edge_m) const {
  if (!box_) return OfAnyShape(center_F, half_edge_m);
  const Eigen::Vector3d to_center_G = FromBox(center_F);
  if (const auto answer = ByBalls(to_center_G.squaredNorm(), half_edge_m)) return *answer;
  const Answer answer = Between(box_->R_F_G * to_center_G, half_edge_m);
  return answer == Answer::kOpen && sharp_ ? OfBoxes(center_F, half_edge_m) : answer;
}

CubeContact::Answer CubeContact::OfBoxes(const Eigen::Vector3d& center_F,
                                         double half_edge_m) const {
  const double gap_m = GapOfBoxes(center_F, half_edge_m);
  if (gap_m > far_m_) return Answer::kNo;
  return gap_m <= -kRounding_m ? Answer::kYes : Answer::kOpen;
}

// Two boxes are apart if and only if they are along one of 15 axes: their own and their cross
// products (Gottschalk, Lin and Manocha, "OBBTree", 1996). R and `apart` are in F, k is G's axis.
double CubeContact::GapOfBoxes(const Eigen::Vector3d& center_F, double half_edge_m) const {
  constexpr double kParallel = 1e-6;  // such a cross product says nothing that the axes do not
  const Eigen::Matrix3d& R = box_->R_F_G;
  const Eigen::Vector3d &half = box_->half_m, apart = center_F - box_->origin_F;
  double gap_m = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double cube_m = half_edge_m * R.col(k).cwiseAbs().sum();
    gap_m = std::max(gap_m, std::abs(R.col(k).dot(apart)) - half[k] - cube_m);
    const double box_m = R.row(k).cwiseAbs().dot(half);
    gap_m = std::max(gap_m, std::abs(apart[k]) - half_edge_m - box_m);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i).cross(R.col(k));
      const double length = axis.norm();
      if (length < kParallel) continue;
      const double reach_m =
          (R.transpose() * axis).cwiseAbs().dot(half) + half_edge_m * axis.cwiseAbs().sum();
      gap_m = std::max(gap_m, (std::abs(axis.dot(apart)) - reach_m) / length);
    }
  }
  return gap_m;
}

// By the balls about the cube and in it.
CubeContact::Answer CubeContact::OfMesh(const Eigen::Vector3d& center_F, double half_edge_m) const {
  const DistanceGrid::Surroundings around = mesh_->Around(shape_.ToG(center_F));
  const double to_corner_m = kToCorner * half_edge_m;
  if (around.same_m > kRounding_m) {
    if (around.inside) return Answer::kYes;
    if (around.near_m > to_corner_m + far_m_ && around.same_m > to_corner_m + kRounding_m) {
      return Answer::kNo;
    }
  }
  return around.far_m + kRounding_m <= half_edge_m + near_m_ ? Answer::kYes : Answer::kOpen;
}

CubeContact::Answer CubeContact::OfAnyShape(const Eigen::Vector3d& center_F,
                                            double half_edge_m) const {
  if (mesh_ != nullptr) return OfMesh(center_F, half_edge_m);
  const std::optional<Eigen::Vector3d> to_center_F = shape_.FromNearestPoint(center_F);
  return to_center_F ? Between(*to_center_F, half_edge_m) : Answer::kOpen;
}

std::optional<Eigen::Vector3d> CubeContact::FromConvex(const Eigen::Vector3d& p_F) const {
  if (line_) return FromLine(p_F);
  if (box_) return box_->R_F_G * FromBox(p_F);
  return mesh_ != nullptr ? std::nullopt : shape_.FromNearestPoint(p_F);
}

CubeContact::Bounds CubeContact::DistanceTo(const Eigen::Vector3d& center_F,
                                            double half_edge_m) const {
  if (mesh_ != nullptr) return MeshDistanceTo(center_F, half_edge_m);
  const std::optional<Eigen::Vector3d> to_center_F = FromConvex(center_F);
  if (!to_center_F) {  // by the boxes alone
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(half_edge_m);
    const Aabb cube{center_F - half, center_F + half};
    return {BoxBoxDistance(shape_.box_F(), cube) - kRounding_m,
            std::numeric_limits<double>::infinity()};
  }
  const auto [least_m, most_m] = FromCore(*to_center_F, half_edge_m);
  return {std::max(least_m - radius_m_, 0.0) - kRounding_m,
          std::max(most_m - radius_m_, 0.0) + kRounding_m};
}

// The plane of FromCore.
std::optional<Separation> CubeContact::Apart(const Eigen::Vector3d& center_F,
                                             double half_edge_m) const {
  const std::optional<Eigen::Vector3d> to_center_F = FromConvex(center_F);
  if (!to_center_F) return std::nullopt;
  const double distance_m = to_center_F->norm();
  if (distance_m == 0) return Separation{};
  const Eigen::Vector3d direction_F = *to_center_F / distance_m;
  const double reach_m = radius_m_ + half_edge_m * direction_F.cwiseAbs().sum();
  return Separation{direction_F, distance_m - reach_m - kRounding_m};
}

// As OfMesh.
CubeContact::Bounds CubeContact::MeshDistanceTo(const Eigen::Vector3d& center_F,
                                                double half_edge_m) const {
  const DistanceGrid::Surroundings around = mesh_->Around(shape_.ToG(center_F));
  const double to_corner_m = kToCorner * half_edge_m;
  if (around.same_m > kRounding_m && around.inside) return {-kRounding_m, kRounding_m};
  const bool outside = around.same_m > to_corner_m + kRounding_m;
  return {outside ? std::max(around.near_m - to_corner_m, 0.0) - kRounding_m : -kRounding_m,
          std::max(around.far_m - half_edge_m, 0.0) + kRounding_m};
}

}  // namespace clearway
