// Shape against shape. FCL stays behind this header.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <variant>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"
#include "collision/mesh_budget.h"
#include "collision/parallel_cylinders.h"

namespace clearway {

class PreparedMesh;

// How much work is worth while on a shape before it is asked about.
enum class Reuse { kFewQueries, kManyQueries };

// A shape prepared for distance queries, in its own frame G. Immutable and cheap to copy; threads
// share it.
class ShapeGeometry {
 public:
  // Meshes must not be empty.
  explicit ShapeGeometry(const Shape& shape, Reuse reuse = Reuse::kFewQueries,
                         const MeshBudget& budget = {});

  const Shape& shape() const { return shape_; }
  const Aabb& box_G() const { return box_G_; }

  // Of every mesh, and of hulls that are worth it; null for the others.
  const PreparedMesh* prepared() const { return prepared_.get(); }

  // The shape lies in the convex hull of its core, grown by this radius; all but meshes fill it.
  double core_radius_m() const;
  Eigen::Vector3d FarthestOfCore(const Eigen::Vector3d& direction_G) const;
  bool convex() const { return !std::holds_alternative<TriangleMesh>(shape_); }

  struct Fcl;  // FCL's form of the shape
  const Fcl& fcl() const { return *fcl_; }

 private:
  Shape shape_;
  Aabb box_G_;
  std::shared_ptr<const PreparedMesh> prepared_;
  std::shared_ptr<const Fcl> fcl_;
};

// A sphere or a capsule at a pose in F: a point or a line, grown by a radius.
struct RoundedLine {
  Eigen::Vector3d center_F;
  Eigen::Vector3d axis_F;  // of length 1
  double half_m;           // of the line's length
  double radius_m;
};

// A box at a pose in F.
struct TurnedBox {
  Eigen::Matrix3d R_F_G;
  Eigen::Vector3d origin_F;
  Eigen::Vector3d half_m;  // of its edges, along G's axes
};

// A shape at a pose in a frame F. Immutable; refers to the geometry it was made of.
//
// Distances are in metres and 0 where the two meet; both sides are solid, a closed mesh too. A
// distance is exact (to 1e-8 m) if it is at most up_to_m; beyond that it is some value greater than
// up_to_m. So "meets within a margin" is DistanceTo(x, margin) <= margin. An exception of FCL or
// libccd gives 0: contact.
class PlacedShape {
 public:
  PlacedShape(const ShapeGeometry& geometry, const Pose& T_F_G);

  const Aabb& box_F() const { return box_F_; }  // the smallest
  Eigen::Vector3d Center_F() const { return R_F_G_ * geometry_->box_G().Center() + origin_F(); }
  const ShapeGeometry& geometry() const { return *geometry_; }
  const Eigen::Matrix3d& R_F_G() const { return R_F_G_; }
  Eigen::Vector3d FarthestOfCore(const Eigen::Vector3d& direction_F) const {
    return R_F_G_ * geometry_->FarthestOfCore(R_F_G_.transpose() * direction_F) + origin_F();
  }
  // The same body, seen from another frame.
  PlacedShape In(const Pose& T_A_F) const { return {*geometry_, T_A_F * T_F_G_}; }
  bool Contains(const Eigen::Vector3d& p_F) const;
  // Whether all of the ball lies in the shape. False is not certain.
  bool Holds(const Eigen::Vector3d& center_F, double radius_m) const;
  // The same set of points, if the shape is of that kind.
  std::optional<RoundedLine> AsRoundedLine() const;
  std::optional<TurnedBox> AsBox() const;
  // The shape as a mesh, if it is prepared for that, and p as its frame sees it.
  const PreparedMesh* AsMesh() const { return geometry_->prepared(); }
  Eigen::Vector3d ToG(const Eigen::Vector3d& p_F) const {
    return R_F_G_.transpose() * (p_F - T_F_G_.translation);
  }
  // If both are cylinders and their axes are parallel; the other at T_F_O.
  std::optional<ParallelCylinders> BesideCylinder(const ShapeGeometry& other,
                                                  const Pose& T_F_O) const;
  // The vector to p from the shape's nearest point, 0 inside; of cylinders alone.
  std::optional<Eigen::Vector3d> FromNearestPoint(const Eigen::Vector3d& p_F) const;

  double DistanceTo(const Aabb& box_F, double up_to_m) const;
  // `other` is convex, at T_F_O. Above up_to_m it is still at most the distance.
  double DistanceToShape(const ShapeGeometry& other, const Pose& T_F_O, double up_to_m) const;
  // Whether the distance is at most margin_m.
  bool Meets(const ShapeGeometry& other, const Pose& T_F_O, double margin_m) const;
  double DistanceToBall(const Eigen::Vector3d& center_F, double radius_m, double up_to_m) const;

 private:
  const Eigen::Vector3d& origin_F() const { return T_F_G_.translation; }
  Aabb TightBox() const;
  double LowerBound(const Aabb& box_F) const;
  const ShapeGeometry* geometry_;
  Pose T_F_G_;
  Eigen::Matrix3d R_F_G_;
  Aabb box_F_;
};

}  // namespace clearway
