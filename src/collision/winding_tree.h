// Winding numbers of meshes of many triangles.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "clearway/geometry/shape.h"
#include "collision/triangle_tree.h"

namespace clearway {

// How often a mesh winds round a point: 1 inside a closed mesh, 0 outside, fractions if it is open.
// Seen from outside their box, the triangles of a node of the tree are replaced by a fan over their
// boundary, which has far fewer and gives the same number: Jacobson et al., "Robust Inside-Outside
// Segmentation using Generalized Winding Numbers", 2013, section 4. Immutable; any number of
// threads may read it. Refers to the tree.
class WindingTree {
 public:
  // The tree must be that of the mesh.
  WindingTree(std::shared_ptr<const Mesh> mesh, const TriangleTree& tree);

  double At(const Eigen::Vector3d& p_G) const;
  // Adds to `work` what that takes: the boxes looked at, and the solid angles.
  double At(const Eigen::Vector3d& p_G, std::uint64_t& work) const;

  struct Edge {
    Eigen::Vector3d from_G, to_G;
  };
  // What the mesh has for a boundary, corners at the same place taken for one; empty if it is
  // closed.
  std::vector<Edge> Boundary() const;
  bool closed() const { return boundary_.empty(); }

 private:
  // An edge between two vertices that a surface has on its boundary, that many times from the lower
  // to the higher one, or the other way if negative.
  struct Side {
    std::uint32_t low, high;
    int times;
  };
  using Sides = std::vector<Side>;  // by their ends
  struct Fan {
    bool used = false;
    Sides sides;
  };

  Sides Build(std::uint32_t node, std::uint32_t& count);
  Sides BoundaryOf(const TriangleTree::Node& leaf) const;
  static Sides Joined(const Sides& a, const Sides& b);
  double AngleOf(const Sides& fan, const Eigen::Vector3d& p_G) const;

  std::shared_ptr<const Mesh> mesh_;
  const TriangleTree& tree_;
  std::vector<std::uint32_t> same_;  // for each vertex, the first one that is where it is
  std::vector<Fan> fans_;            // of the tree's nodes
  Sides boundary_;
};

}  // namespace clearway
