// Distances from a mesh, stored.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "collision/mesh_budget.h"
#include "collision/triangle_tree.h"
#include "collision/winding_tree.h"

namespace clearway {

// The signed distance from a mesh's surface at the centres of the cells of a grid over the mesh's
// box, in the mesh's frame G, and from these what is certain of any other point. Immutable; any
// number of threads may read it.
//
// There are more cells the more triangles there are. Where the budget does not reach, bounds of the
// distance are stored, and sides are not known.
class DistanceGrid {
 public:
  DistanceGrid(const Aabb& mesh_box_G, const TriangleTree& tree, const WindingTree& winding,
               const MeshBudget& budget);

  // What is certain about a point. All bounds hold in spite of the stored numbers' rounding.
  struct Surroundings {
    double near_m;  // the surface is at least this far, or the number is not positive
    double far_m;   // and at most this far
    double same_m;  // what is nearer than this is inside as the point is, or else outside
    bool inside;    // certain if same_m > 1e-9
  };
  Surroundings At(const Eigen::Vector3d& p_G) const {
    const Eigen::Vector3d in_box_G = p_G.cwiseMax(box_G_.min).cwiseMin(box_G_.max);
    const Eigen::Vector3d in_cells = (in_box_G - box_G_.min) * per_cell_;
    const int x = std::min(static_cast<int>(in_cells.x()), size_.x() - 1);
    const int y = std::min(static_cast<int>(in_cells.y()), size_.y() - 1);
    const int z = std::min(static_cast<int>(in_cells.z()), size_.z() - 1);
    const std::size_t cell = IndexOf(x, y, z);
    const double stored_m = signed_m_[cell];
    const double distance_m = std::abs(stored_m);
    const double off_m = (in_box_G - CenterOf(x, y, z)).norm();
    const double squared_beyond = (p_G - in_box_G).squaredNorm();
    const double same_m = same_m_.empty() ? distance_m : same_m_[cell];
    const Surroundings around{
        distance_m * (1 - kRounding) - off_m,
        (far_m_.empty() ? distance_m : far_m_[cell]) * (1 + kRounding) + off_m,
        same_m * (1 - kRounding) - off_m, stored_m < 0};
    return squared_beyond == 0 ? around : Beyond(squared_beyond, around);
  }

 private:
  static constexpr double kRounding = 1.2e-7;  // relative, of a float

  std::size_t IndexOf(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size_.y() + y) * size_.x() + x;
  }
  Eigen::Vector3d CenterOf(int x, int y, int z) const {
    return box_G_.min + cell_m_ * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
  }
  // Of a point beyond the grid's box, from what is known of the box's nearest point: there the
  // lines to it and to any point of the surface meet at a right angle or more.
  Surroundings Beyond(double squared_beyond, const Surroundings& at_box) const {
    const double beyond_m = std::sqrt(squared_beyond), least_m = std::max(0.0, at_box.near_m);
    const double near_m = std::sqrt(squared_beyond + least_m * least_m) * (1 - 1e-15);
    const double far_m = at_box.far_m + beyond_m;
    if (same_m_.empty()) return {near_m, far_m, near_m, false};
    const double around_box_m = at_box.inside ? 0 : at_box.same_m - beyond_m;
    return {near_m, far_m, std::max(beyond_m, around_box_m), false};
  }

  void Lay(const Aabb& mesh_box_G, double most_cells);
  Eigen::Vector3d CenterOf(std::size_t cell) const;
  std::vector<double> Distances(const TriangleTree& tree, std::uint64_t visits);
  void FindSides(const std::vector<double>& distances_m, const Aabb& mesh_box_G,
                 const WindingTree& winding, std::uint64_t angles);
  template <class Visit>
  void ForEachWithin(const Eigen::Vector3d& p_G, double radius_m, Visit&& visit) const;

  Aabb box_G_;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  double cell_m_ = 0, per_cell_ = 0;
  std::vector<float> signed_m_;  // at most the distance; negative inside
  std::vector<float> far_m_;     // at least the distance; empty if that is known for all cells
  std::vector<float> same_m_;    // empty if it is the distance: closed meshes, sides all known
};

}  // namespace clearway
