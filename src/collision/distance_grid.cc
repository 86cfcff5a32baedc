#include "collision/distance_grid.h"

#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include "clearway/geometry/distance.h"

namespace clearway {
namespace {

constexpr int kMostAlong = 128;  // cells along an axis
constexpr double kRounding_m = 1e-9;

// On which side of a mesh a point is, and how far that is so all round it.
struct Side {
  bool inside;
  double same_m;
};

// Tells sides by winding numbers. Without a boundary, they change at the surface alone. With one,
// they also change as the boundary of length L is seen to turn: with r metres from it by no more
// than L / (4 pi r^2) a metre (the law of Biot and Savart).
class SideFinder {
 public:
  SideFinder(const Aabb& mesh_box_G, const WindingTree& winding)
      : box_G_(mesh_box_G), winding_(winding), boundary_(winding.Boundary()) {
    for (const auto& [from_G, to_G] : boundary_) length_m_ += (to_G - from_G).norm();
  }

  bool closed() const { return boundary_.empty(); }
  std::uint64_t angles() const { return angles_; }  // looked at so far

  // Of a point that is to_surface_m from the surface, or farther.
  Side At(const Eigen::Vector3d& p_G, double to_surface_m) {
    const double winding = std::abs(winding_.At(p_G, angles_));
    const bool in_box = box_G_.Contains(p_G);
    if (closed()) return {in_box && winding > 0.5, to_surface_m};
    const double steady_m = std::min(to_surface_m, SteadyRadius(p_G, to_surface_m, winding));
    const double to_box_m = PointBoxDistance(p_G, box_G_);
    if (winding <= 0.5) return {false, std::max(steady_m, to_box_m)};
    if (!in_box) return {false, to_box_m};
    const double to_face_m = std::min((p_G - box_G_.min).minCoeff(), (box_G_.max - p_G).minCoeff());
    return {true, std::min(steady_m, to_face_m)};
  }

 private:
  // The largest radius t * r in which L t r / (4 pi (r - t r)^2) is at most what the winding number
  // differs from a half.
  double SteadyRadius(const Eigen::Vector3d& p_G, double to_surface_m, double winding) {
    constexpr std::size_t kFew = 256;
    double r_m = to_surface_m;
    if (boundary_.size() <= kFew) {
      r_m = std::numeric_limits<double>::infinity();
      angles_ += boundary_.size();
      for (const auto& [from_G, to_G] : boundary_) {
        r_m = std::min(r_m, PointSegmentDistance(p_G, from_G, to_G));
      }
    }
    const double k = 4 * std::numbers::pi * r_m * std::abs(winding - 0.5) / length_m_;
    return r_m * 2 * k / (2 * k + 1 + std::sqrt(4 * k + 1));
  }

  const Aabb& box_G_;
  const WindingTree& winding_;
  std::vector<WindingTree::Edge> boundary_;
  double length_m_ = 0;
  std::uint64_t angles_ = 0;
};

// Rounded to a float that is not larger, or not smaller.
float Below(double value) { return static_cast<float>(value * (1 - 1e-7)); }
float Above(double value) { return static_cast<float>(value * (1 + 1e-7)); }

}  // namespace

DistanceGrid::DistanceGrid(const Aabb& mesh_box_G, const TriangleTree& tree,
                           const WindingTree& winding, const MeshBudget& budget) {
  Lay(mesh_box_G, std::min(budget.cells, WantedCells(tree.triangles().size())));
  FindSides(Distances(tree, budget.visits), mesh_box_G, winding, budget.angles);
}

// Cubic cells, the smallest of which there are not too many, and half of one or more round the box.
void DistanceGrid::Lay(const Aabb& mesh_box_G, double most_cells) {
  constexpr double kFewest = 8;  // the corners of the box
  const Eigen::Vector3d mesh_size_m = mesh_box_G.Size();
  constexpr double kSmallest_m = 1e-6;
  cell_m_ = std::max(mesh_size_m.maxCoeff() / (kMostAlong - 2), kSmallest_m);
  const auto along = [&]() -> Eigen::Array3d { return (mesh_size_m / cell_m_).array().ceil() + 1; };
  while (along().prod() > std::max(kFewest, most_cells)) cell_m_ *= 1.02;
  per_cell_ = 1 / cell_m_;
  size_ = along().cast<int>();
  const Eigen::Vector3d half_m = 0.5 * cell_m_ * size_.cast<double>();
  box_G_ = {mesh_box_G.Center() - half_m, mesh_box_G.Center() + half_m};
}

Eigen::Vector3d DistanceGrid::CenterOf(std::size_t cell) const {
  const std::size_t row = cell / size_.x();
  return CenterOf(static_cast<int>(cell % size_.x()), static_cast<int>(row % size_.y()),
                  static_cast<int>(row / size_.y()));
}

// Lower bounds, and upper ones where they differ. What is nearest to one cell is near to the next;
// what one cell has left of its share of the visits, the next ones have.
std::vector<double> DistanceGrid::Distances(const TriangleTree& tree, std::uint64_t visits) {
  const auto count = static_cast<std::size_t>(size_.prod());
  std::vector<double> near_m(count), far_m(count);
  std::uint32_t triangle = 0;
  for (std::size_t cell = 0; cell < count; ++cell) {
    const Eigen::Vector3d center_G = CenterOf(cell);
    const auto& [a, b, c] = tree.triangles()[triangle];
    const double seed_m = PointTriangleDistance(center_G, a, b, c);
    const TriangleTree::Nearest found =
        tree.NearestTo(center_G, seed_m + kRounding_m, visits / (count - cell));
    visits -= std::min(visits, found.visits);
    if (found.distance_m <= seed_m) triangle = found.triangle;
    far_m[cell] = std::min(found.distance_m, seed_m);
    near_m[cell] = std::min(found.at_least_m, far_m[cell]);
  }
  if (near_m != far_m)
    std::transform(far_m.begin(), far_m.end(), std::back_inserter(far_m_), Above);
  return near_m;
}

template <class Visit>
void DistanceGrid::ForEachWithin(const Eigen::Vector3d& p_G, double radius_m, Visit&& visit) const {
  const auto cell_of = [&](double along, int axis) {
    const double index = (p_G[axis] + along - box_G_.min[axis]) * per_cell_;
    return std::clamp(static_cast<int>(std::clamp(index, 0.0, 1e6)), 0, size_[axis] - 1);
  };
  for (int z = cell_of(-radius_m, 2); z <= cell_of(radius_m, 2); ++z) {
    for (int y = cell_of(-radius_m, 1); y <= cell_of(radius_m, 1); ++y) {
      for (int x = cell_of(-radius_m, 0); x <= cell_of(radius_m, 0); ++x) visit(IndexOf(x, y, z));
    }
  }
}

// From the cells farthest from the surface on, each settles those round it.
void DistanceGrid::FindSides(const std::vector<double>& distances_m, const Aabb& mesh_box_G,
                             const WindingTree& winding, std::uint64_t angles) {
  SideFinder sides(mesh_box_G, winding);
  const std::size_t count = distances_m.size();
  signed_m_.assign(distances_m.begin(), distances_m.end());
  same_m_.assign(count, 0);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return distances_m[l] > distances_m[r]; });
  std::vector<bool> settled(count, false);
  const auto settle = [&](std::size_t cell, bool inside, double same_m) {
    settled[cell] = true;
    if (inside) signed_m_[cell] = -signed_m_[cell];
    same_m_[cell] = Below(sides.closed() ? distances_m[cell] : same_m);
  };
  for (const std::size_t cell : order) {
    if (settled[cell]) continue;
    if (distances_m[cell] <= kRounding_m) break;
    if (sides.angles() >= angles) return;
    const Eigen::Vector3d center_G = CenterOf(cell);
    const auto [inside, same_m] = sides.At(center_G, distances_m[cell]);
    settle(cell, inside, same_m);
    ForEachWithin(center_G, same_m, [&, inside = inside, same_m = same_m](std::size_t other) {
      if (settled[other]) return;
      const double left_m = same_m - (CenterOf(other) - center_G).norm();
      const double wanted_m = sides.closed() ? kRounding_m : 0.25 * distances_m[other];
      if (left_m > wanted_m) settle(other, inside, std::min(left_m, distances_m[other]));
    });
  }
  if (sides.closed()) same_m_ = {};
}

}  // namespace clearway
