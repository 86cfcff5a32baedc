#include "collision/winding_tree.h"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace clearway {
namespace {

std::vector<std::uint32_t> FirstAtSamePlace(const std::vector<Eigen::Vector3d>& points) {
  const auto key = [&](std::uint32_t i) {
    return std::make_tuple(points[i].x(), points[i].y(), points[i].z(), i);
  };
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto l, auto r) { return key(l) < key(r); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

}  // namespace

WindingTree::WindingTree(std::shared_ptr<const Mesh> mesh, const TriangleTree& tree)
    : mesh_(std::move(mesh)),
      tree_(tree),
      same_(FirstAtSamePlace(mesh_->vertices)),
      fans_(tree.nodes().size()) {
  std::uint32_t count = 0;
  boundary_ = Build(0, count);
}

// Sets the fans of the node and of those below it; returns the node's boundary and adds to `count`
// its triangles.
WindingTree::Sides WindingTree::Build(std::uint32_t index, std::uint32_t& count) {
  const TriangleTree::Node& node = tree_.nodes()[index];
  std::uint32_t here = node.count;
  Sides sides;
  if (node.count > 0) {
    sides = BoundaryOf(node);
  } else {
    const Sides left = Build(node.first, here);
    sides = Joined(left, Build(node.first + 1, here));
  }
  fans_[index].used = sides.size() < here;
  if (fans_[index].used) fans_[index].sides = sides;
  count += here;
  return sides;
}

WindingTree::Sides WindingTree::BoundaryOf(const TriangleTree::Node& leaf) const {
  Sides boundary;
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const auto& corners = mesh_->triangles[tree_.order()[i]];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t from = same_[corners[k]], to = same_[corners[(k + 1) % 3]];
      if (from == to) continue;
      const Side side{std::min(from, to), std::max(from, to), from < to ? 1 : -1};
      boundary = Joined(boundary, {side});
    }
  }
  return boundary;
}

WindingTree::Sides WindingTree::Joined(const Sides& a, const Sides& b) {
  const auto ends = [](const Side& side) { return std::tie(side.low, side.high); };
  Sides both(a.size() + b.size());
  std::merge(a.begin(), a.end(), b.begin(), b.end(), both.begin(),
             [&](const Side& l, const Side& r) { return ends(l) < ends(r); });
  Sides joined;
  for (const Side& side : both) {
    if (!joined.empty() && ends(joined.back()) == ends(side)) {
      joined.back().times += side.times;
    } else {
      if (!joined.empty() && joined.back().times == 0) joined.pop_back();
      joined.push_back(side);
    }
  }
  if (!joined.empty() && joined.back().times == 0) joined.pop_back();
  return joined;
}

std::vector<WindingTree::Edge> WindingTree::Boundary() const {
  std::vector<Edge> edges;
  for (const Side& side : boundary_) {
    for (int i = 0; i < std::abs(side.times); ++i) {
      edges.push_back({mesh_->vertices[side.low], mesh_->vertices[side.high]});
    }
  }
  return edges;
}

// Of the triangles between the fan's hub, a corner of its own, and its sides.
double WindingTree::AngleOf(const Sides& fan, const Eigen::Vector3d& p_G) const {
  if (fan.empty()) return 0;
  const std::uint32_t hub = fan.front().low;
  const Eigen::Vector3d to_hub = mesh_->vertices[hub] - p_G;
  double angle = 0;
  for (const Side& side : fan) {
    if (side.low == hub || side.high == hub) continue;
    angle += side.times *
             SolidAngle(to_hub, mesh_->vertices[side.low] - p_G, mesh_->vertices[side.high] - p_G);
  }
  return angle;
}

double WindingTree::At(const Eigen::Vector3d& p_G) const {
  std::uint64_t work = 0;
  return At(p_G, work);
}

double WindingTree::At(const Eigen::Vector3d& p_G, std::uint64_t& work) const {
  std::vector<std::uint32_t> open = {0};
  double angle = 0;
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    open.pop_back();
    const TriangleTree::Node& node = tree_.nodes()[index];
    ++work;
    if (fans_[index].used && node.Outside(p_G)) {
      work += fans_[index].sides.size();
      angle += AngleOf(fans_[index].sides, p_G);
      continue;
    }
    work += node.count;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Triangle& t = tree_.triangles()[i];
      angle += SolidAngle(t.a - p_G, t.b - p_G, t.c - p_G);
    }
    if (node.count == 0) open.insert(open.end(), {node.first + 1, node.first});
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace clearway
