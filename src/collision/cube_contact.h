// Quick answers of a shape against axis-aligned cubes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>

#include "collision/narrowphase.h"
#include "collision/separation.h"

namespace clearway {

// A placed shape with a margin round it, asked about cubes of any size: voxels, and what holds many
// of them. Refers to the shape.
class CubeContact {
 public:
  CubeContact(const PlacedShape& shape, double margin_m);

  // kNo is certain with 1e-9 m to spare. So is kYes if the shape is rounded or has a margin; if
  // not, it is up to rounding. kOpen is not known.
  enum class Answer { kNo, kYes, kOpen };
  Answer Of(const Eigen::Vector3d& center_F, double half_edge_m) const {
    return line_ ? OfRounded(FromLine(center_F), half_edge_m) : OfOther(center_F, half_edge_m);
  }

  // The distance between shape and cube, whatever the margin, lies between these, with 1e-9 m to
  // spare.
  struct Bounds {
    double least_m, most_m;
  };
  Bounds DistanceTo(const Eigen::Vector3d& center_F, double half_edge_m) const;
  // Along the way from the shape's nearest point to the cube's centre. None is known for meshes,
  // and for hulls that are not prepared as such.
  std::optional<Separation> Apart(const Eigen::Vector3d& center_F, double half_edge_m) const;

 private:
  static constexpr double kToCorner = 1.7320508075688774;  // of a cube's centre, in half edges
  static constexpr double kRounding_m = 1e-9;

  // From the nearest point of the line.
  Eigen::Vector3d FromLine(const Eigen::Vector3d& p_F) const {
    const Eigen::Vector3d from_middle_F = p_F - line_->center_F;
    const double along_m = line_->axis_F.dot(from_middle_F);
    return from_middle_F - std::clamp(along_m, -line_->half_m, line_->half_m) * line_->axis_F;
  }
  // In G, from the nearest point of the box.
  Eigen::Vector3d FromBox(const Eigen::Vector3d& p_F) const {
    const Eigen::Vector3d p_G = box_->R_F_G.transpose() * (p_F - box_->origin_F);
    return p_G - p_G.cwiseMin(box_->half_m).cwiseMax(-box_->half_m);
  }
  // What the balls about the cube and in it tell.
  std::optional<Answer> ByBalls(double squared_distance, double half_edge_m) const {
    const double beyond_ball_m = kToCorner * half_edge_m + far_m_;
    if (squared_distance > beyond_ball_m * beyond_ball_m) return Answer::kNo;
    const double within_ball_m = half_edge_m + near_m_;
    if (squared_distance <= within_ball_m * within_ball_m) return Answer::kYes;
    return std::nullopt;
  }
  Answer OfRounded(const Eigen::Vector3d& to_center_F, double half_edge_m) const {
    const auto answer = ByBalls(to_center_F.squaredNorm(), half_edge_m);
    return answer ? *answer : Between(to_center_F, half_edge_m);
  }
  // The distance of a cube from the line or the shape, where its centre is so far from the nearest
  // point.
  static Bounds FromCore(const Eigen::Vector3d& to_center_F, double half_edge_m);
  // As FromCore, with neither a division nor a root.
  Answer Between(const Eigen::Vector3d& to_center_F, double half_edge_m) const {
    const Eigen::Array3d gap = to_center_F.array().abs();
    const double squared = to_center_F.squaredNorm();
    // Over the distance: how far the cube surely is from the core.
    const double least = squared - half_edge_m * gap.sum();
    if (least > 0 && least * least > far_m_ * far_m_ * squared) return Answer::kNo;
    const double most_squared = (gap - half_edge_m).max(0).matrix().squaredNorm();
    return most_squared <= near_m_ * near_m_ ? Answer::kYes : Answer::kOpen;
  }
  Answer OfOther(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Answer OfBoxes(const Eigen::Vector3d& center_F, double half_edge_m) const;
  double GapOfBoxes(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Answer OfMesh(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Answer OfAnyShape(const Eigen::Vector3d& center_F, double half_edge_m) const;
  Bounds MeshDistanceTo(const Eigen::Vector3d& center_F, double half_edge_m) const;
  // From the line, or from the nearest point of a shape that has a closed form for it.
  std::optional<Eigen::Vector3d> FromConvex(const Eigen::Vector3d& p_F) const;

  const PlacedShape& shape_;
  // At most one of these.
  std::optional<RoundedLine> line_;
  std::optional<TurnedBox> box_;
  const PreparedMesh* mesh_;
  bool sharp_;       // neither rounded nor with a margin beyond contact
  double radius_m_;  // of a rounded line
  // A cube certainly touches if it is as near as near_m_ to the line or to the shape, and does not
  // beyond far_m_.
  double near_m_, far_m_;
};

}  // namespace clearway
