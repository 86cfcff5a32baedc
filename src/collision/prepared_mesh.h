// A triangle mesh made ready for many queries.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "clearway/geometry/shape.h"
#include "collision/distance_grid.h"
#include "collision/extreme_points.h"
#include "collision/mesh_budget.h"
#include "collision/oriented_box.h"
#include "collision/triangle_tree.h"
#include "collision/winding_tree.h"

namespace clearway {

// The solid of a mesh in the sense of Contains(TriangleMesh), in the mesh's frame G. A grid of
// distances answers most questions; the others go to the triangles. Motion leaves it as it is.
// What it takes to make stands at PreparedRobot. Immutable; any number of threads may read it.
//
// Distances are in metres and 0 where the two meet, exact to 1e-9 m for points and to 1e-7 m for
// boxes if at most up_to_m, and above up_to_m beyond that.
class PreparedMesh {
 public:
  explicit PreparedMesh(std::shared_ptr<const Mesh> mesh, const MeshBudget& budget = {});
  PreparedMesh(const PreparedMesh&) = delete;
  PreparedMesh& operator=(const PreparedMesh&) = delete;

  bool Contains(const Eigen::Vector3d& p_G) const;
  double DistanceTo(const Eigen::Vector3d& p_G, double up_to_m) const;
  // The box counts as inside if its centre is.
  double DistanceTo(const OrientedBox& box, double up_to_m) const;
  // Whether all of the ball is inside (true) or outside; nothing if it lies on both sides or, of an
  // open mesh, if that is not known.
  std::optional<bool> SideOf(const Eigen::Vector3d& center_G, double radius_m) const;

  // The smallest box around the mesh, turned into a frame F. Its origin is G's.
  Aabb BoxTurned(const Eigen::Matrix3d& R_F_G) const { return extreme_.BoxTurned(R_F_G); }
  // The point farthest in a direction of the mesh, or of what is known to hold it.
  const Eigen::Vector3d& Farthest(const Eigen::Vector3d& direction_G) const {
    return extreme_.Farthest(direction_G);
  }

  const TriangleTree& tree() const { return tree_; }
  bool closed() const { return winding_.closed(); }

  // What is known of a point at once.
  DistanceGrid::Surroundings Around(const Eigen::Vector3d& p_G) const { return grid_.At(p_G); }

 private:
  Aabb box_G_;
  ExtremePoints extreme_;
  TriangleTree tree_;
  WindingTree winding_;
  DistanceGrid grid_;
};

}  // namespace clearway
