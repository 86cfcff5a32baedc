#include "geometry/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "absl/container/flat_hash_map.h"

namespace clearway {
namespace {

using Cell = std::array<std::int64_t, 3>;
using FirstInCell = absl::flat_hash_map<Cell, std::uint32_t>;

Cell CellOf(const Eigen::Vector3d& p, double size_m) {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = static_cast<std::int64_t>(std::floor(p[axis] / size_m));
  }
  return cell;
}

// The first point within the tolerance of point i among those that stand for a cell; else i.
std::uint32_t NearIn(const FirstInCell& first, const Cell& cell,
                     const std::vector<Eigen::Vector3d>& points, std::uint32_t i,
                     double tolerance_m) {
  std::uint32_t found = i;
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const Cell other{cell[0] + neighbour % 3 - 1, cell[1] + neighbour / 3 % 3 - 1,
                     cell[2] + neighbour / 9 - 1};
    const auto entry = first.find(other);
    if (entry == first.end()) continue;
    const bool near = (points[entry->second] - points[i]).norm() <= tolerance_m;
    if (near) found = std::min(found, entry->second);
  }
  return found;
}

}  // namespace

std::vector<std::uint32_t> WeldEqual(const std::vector<Eigen::Vector3d>& points) {
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

std::vector<std::uint32_t> WeldNear(const std::vector<Eigen::Vector3d>& points,
                                    double tolerance_m) {
  std::vector<std::uint32_t> standing(points.size());
  FirstInCell first;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Cell cell = CellOf(points[i], tolerance_m);
    standing[i] = NearIn(first, cell, points, i, tolerance_m);
    if (standing[i] == i) first.try_emplace(cell, i);
  }
  return standing;
}

}  // namespace clearway
