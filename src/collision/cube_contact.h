// Quick answers of a shape against axis-aligned cubes.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "collision/narrowphase.h"

namespace clearway {

// A placed shape with a margin round it, asked about cubes of any size: voxels, and what holds many
// of them. Refers to the shape.
class CubeContact {
 public:
  CubeContact(const PlacedShape& shape, double margin_m);

  // kNo and kYes are certain, with 1e-9 m to spare; kOpen is not known.
  enum class Answer { kNo, kYes, kOpen };
  Answer Of(const Eigen::Vector3d& center_F, double half_edge_m) const {
    if (!core_) return OfAnyShape(center_F, half_edge_m);
    const Eigen::Vector3d to_center = FromCore(center_F);
    const double squared = to_center.squaredNorm();
    const double beyond_ball_m = kToCorner * half_edge_m + far_m_;
    if (squared > beyond_ball_m * beyond_ball_m) return Answer::kNo;
    const double within_ball_m = half_edge_m + near_m_;
    if (squared <= within_ball_m * within_ball_m) return Answer::kYes;
    const Answer answer = Between(core_->R_F_G * to_center, half_edge_m);
    if (answer != Answer::kOpen || !is_box_) return answer;
    return OfBoxes(center_F, half_edge_m);
  }

 private:
  static constexpr double kToCorner = 1.7320508075688774;  // of a cube's centre, in half edges
  static constexpr double kRounding_m = 1e-9;

  // In G, from the nearest point of the box that, rounded, is the shape.
  Eigen::Vector3d FromCore(const Eigen::Vector3d& p_F) const {
    const Eigen::Vector3d p_G = core_->R_F_G.transpose() * (p_F - core_->origin_F);
    return p_G - p_G.cwiseMin(core_->half_m).cwiseMax(-core_->half_m);
  }
  Answer Between(const Eigen::Vector3d& to_center_F, double half_edge_m) const;
  Answer OfBoxes(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Answer OfMesh(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Answer OfAnyShape(const Eigen::Vector3d& center_F, double half_edge_m) const;

  const PlacedShape& shape_;
  std::optional<RoundedBox> core_;
  const PreparedMesh* mesh_;
  bool is_box_;  // not rounded, and without a margin
  // A cube certainly touches if it is as near as near_m_ to the core, and does not beyond far_m_.
  double near_m_, far_m_;
};

}  // namespace clearway
