#include "collision/prepared_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearway {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-9;
constexpr double kThin_m = 1e-6;  // what is that near almost always meets

}  // namespace

PreparedMesh::PreparedMesh(std::shared_ptr<const Mesh> mesh, const MeshBudget& budget)
    : box_G_(BoundingBox(TriangleMesh{mesh})),
      extreme_(mesh->vertices),
      tree_(*mesh),
      winding_(mesh, tree_),
      grid_(box_G_, tree_, winding_, budget) {}

bool PreparedMesh::Contains(const Eigen::Vector3d& p_G) const {
  if (!box_G_.Contains(p_G)) return false;
  const DistanceGrid::Surroundings around = grid_.At(p_G);
  return around.same_m > kRounding_m ? around.inside : std::abs(winding_.At(p_G)) > 0.5;
}

double PreparedMesh::DistanceTo(const Eigen::Vector3d& p_G, double up_to_m) const {
  if (Contains(p_G)) return 0;
  const DistanceGrid::Surroundings around = grid_.At(p_G);
  if (around.near_m > up_to_m) return around.near_m;
  return tree_.NearestTo(p_G, std::min(up_to_m, around.far_m + kRounding_m)).distance_m;
}

// Of a closed mesh sides change at the surface alone.
std::optional<bool> PreparedMesh::SideOf(const Eigen::Vector3d& center_G, double radius_m) const {
  const DistanceGrid::Surroundings around = grid_.At(center_G);
  if (around.same_m > radius_m + kRounding_m) return around.inside;
  const double reach_m = radius_m + kRounding_m;
  if (!closed() || tree_.NearestTo(center_G, reach_m).distance_m <= reach_m) return std::nullopt;
  return Contains(center_G);
}

// The surface is as near to the box as to its centre, less what the box reaches towards it.
double PreparedMesh::DistanceTo(const OrientedBox& box, double up_to_m) const {
  const DistanceGrid::Surroundings around = grid_.At(box.center_G);
  if (around.same_m > kRounding_m && around.inside) return 0;
  const double at_least_m = around.near_m - box.half_m.norm() - kRounding_m;
  if (at_least_m <= 0 && up_to_m <= kThin_m && !tree_.Meets(box.Padded(up_to_m))) {
    return Contains(box.center_G) ? 0 : kFar;
  }
  if (at_least_m <= 0 && tree_.Meets(box)) return 0;
  if (Contains(box.center_G)) return 0;
  if (at_least_m > up_to_m) return at_least_m;
  if (up_to_m <= 0) return kFar;
  const double at_most_m = std::max(0.0, around.far_m - box.half_m.minCoeff()) + kRounding_m;
  return tree_.NearestTo(box, std::min(up_to_m, at_most_m)).distance_m;
}

}  // namespace clearway
