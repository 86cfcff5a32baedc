#include "collision/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/distance.h"

namespace clearway {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-12;  // of coordinates within 100 m
constexpr double kTouching_m = 1e-9;   // what Meet allows

Eigen::Vector3d ThriceCentroid(const Triangle& t) { return t.a + t.b + t.c; }

Aabb BoxOf(const Triangle& t) {
  return {t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
}

// Of the gaps along G's axes, and along the box's.
double GapBetween(const TriangleTree::Node& node, const OrientedBox& box) {
  const Eigen::Vector3d apart_G = node.center_G - box.center_G;
  const double along_G =
      (apart_G.cwiseAbs() - node.half_m - box.reach_G).cwiseMax(0.0).squaredNorm();
  const double along_B =
      ((box.R_B_G * apart_G).cwiseAbs() - box.half_m - box.abs_R_B_G * node.half_m)
          .cwiseMax(0.0)
          .squaredNorm();
  return std::sqrt(std::max(along_G, along_B));
}

bool MayMeet(const TriangleTree::Node& node, const OrientedBox& box) {
  const Eigen::Vector3d apart_G = node.center_G - box.center_G;
  if ((apart_G.cwiseAbs().array() > (node.half_m + box.reach_G).array() + kTouching_m).any()) {
    return false;
  }
  return ((box.R_B_G * apart_G).cwiseAbs().array() <=
          (box.half_m + box.abs_R_B_G * node.half_m).array() + kTouching_m)
      .all();
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) : order_(mesh.triangles.size()) {
  std::vector<Triangle> all;
  all.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    all.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
  }
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(all.size());
  nodes_.emplace_back();
  Build(0, 0, static_cast<std::uint32_t>(all.size()), all);
  triangles_.reserve(all.size());
  for (const std::uint32_t index : order_) triangles_.push_back(all[index]);
}

// Halves by number, across the longest side of the box around the centroids.
void TriangleTree::Build(std::uint32_t node, std::uint32_t first, std::uint32_t last,
                         const std::vector<Triangle>& all) {
  Aabb box, centroids;
  for (std::uint32_t i = first; i < last; ++i) {
    box.Extend(BoxOf(all[order_[i]]));
    centroids.Extend(ThriceCentroid(all[order_[i]]));
  }
  const std::uint32_t count = last - first;
  const Eigen::Vector3d half_m = (0.5 * box.Size()).array() + kRounding_m;
  nodes_[node] = {box.Center(), half_m, first, count};
  if (count <= kLeafSize) return;
  int axis = 0;
  centroids.Size().maxCoeff(&axis);
  const std::uint32_t middle = first + count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t l, std::uint32_t r) {
                     return ThriceCentroid(all[l])[axis] < ThriceCentroid(all[r])[axis];
                   });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = children;
  nodes_[node].count = 0;
  nodes_.resize(nodes_.size() + 2);
  Build(children, first, middle, all);
  Build(children + 1, middle, last, all);
}

// Depth first, the nearer child before the other.
template <class Bound, class Measure>
TriangleTree::Nearest TriangleTree::Search(double up_to_m, const Bound& bound,
                                           const Measure& measure,
                                           std::uint64_t most_visits) const {
  struct Open {
    double bound_m;
    std::uint32_t node;
  };
  std::array<Open, kMaxDepth> open;
  std::size_t size = 0;
  double limit_m = up_to_m;
  Nearest nearest{kFar, 0, 0, 0};
  open[size++] = {bound(nodes_[0], limit_m), 0};
  while (size > 0 && nearest.visits < most_visits) {
    const Open next = open[--size];
    if (next.bound_m > limit_m) continue;
    const Node& node = nodes_[next.node];
    nearest.visits += 1 + node.count;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const double distance_m = measure(triangles_[i], limit_m);
      if (distance_m > limit_m) continue;
      limit_m = nearest.distance_m = distance_m;
      nearest.triangle = i;
      if (distance_m <= 0) return nearest;
    }
    if (node.count > 0) continue;
    Open near{bound(nodes_[node.first], limit_m), node.first};
    Open far{bound(nodes_[node.first + 1], limit_m), node.first + 1};
    if (far.bound_m < near.bound_m) std::swap(near, far);
    if (far.bound_m <= limit_m) open[size++] = far;
    if (near.bound_m <= limit_m) open[size++] = near;
  }
  nearest.at_least_m = limit_m;
  while (size > 0) nearest.at_least_m = std::min(nearest.at_least_m, open[--size].bound_m);
  return nearest;
}

TriangleTree::Nearest TriangleTree::NearestTo(const Eigen::Vector3d& p_G, double up_to_m,
                                              std::uint64_t most_visits) const {
  return Search(
      up_to_m,
      [&](const Node& node, double) {
        return ((p_G - node.center_G).cwiseAbs() - node.half_m).cwiseMax(0.0).norm();
      },
      [&](const Triangle& t, double) { return PointTriangleDistance(p_G, t.a, t.b, t.c); },
      most_visits);
}

TriangleTree::Nearest TriangleTree::NearestTo(const OrientedBox& box, double up_to_m) const {
  return Search(
      up_to_m, [&](const Node& node, double) { return GapBetween(node, box); },
      [&](const Triangle& t, double limit_m) { return Distance(t, box, limit_m); });
}

double TriangleTree::Least(double limit, absl::FunctionRef<double(const Node&, double limit)> bound,
                           absl::FunctionRef<double(const Triangle&, double limit)> measure) const {
  return Search(limit, bound, measure).distance_m;
}

bool TriangleTree::Meets(const OrientedBox& box) const {
  std::array<std::uint32_t, kMaxDepth> open;
  std::size_t size = 0;
  open[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[open[--size]];
    if (!MayMeet(node, box)) continue;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (Meet(triangles_[node.first + i], box)) return true;
    }
    if (node.count > 0) continue;
    open[size++] = node.first + 1;
    open[size++] = node.first;
  }
  return false;
}

}  // namespace clearway
