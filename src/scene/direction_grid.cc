#include "scene/direction_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace clearway {
namespace {

// Cells on the six faces of a cube about the sensor, so many each way: of 0.9 degrees in the middle
// of a face and 0.45 at its edge. A rim about each face is always empty.
constexpr int kAcross = 128;
constexpr int kRow = kAcross + 2;
constexpr int kCells = 6 * kRow * kRow;
constexpr std::uint32_t kFirst = kRow + 1;  // that is not in the rim

std::uint32_t CellOf(const Eigen::Vector3f& d) {
  int axis = std::abs(d[1]) > std::abs(d[0]) ? 1 : 0;
  if (std::abs(d[2]) > std::abs(d[axis])) axis = 2;
  if (d[axis] == 0) return kFirst;
  const float scale = 0.5f * kAcross / std::abs(d[axis]);
  const auto place = [&](float x) {
    return std::min(static_cast<int>(x * scale + 0.5f * kAcross), kAcross - 1);
  };
  const int face = 2 * axis + (d[axis] < 0 ? 1 : 0);
  const int u = place(d[(axis + 1) % 3]), v = place(d[(axis + 2) % 3]);
  return kFirst + static_cast<std::uint32_t>((face * kRow + v) * kRow + u);
}

// The first cells of the three rows of three about a cell.
std::array<std::uint32_t, 3> RowsAbout(std::uint32_t cell) {
  return {cell - kRow - 1, cell - 1, cell + kRow - 1};
}

// How much farther or nearer a neighbour may be.
float Apart_m(float range_m) { return 0.03f * range_m + 0.2f; }

// Of each cell, the points of objects within a cell of it.
std::vector<std::uint16_t> CountObjectPoints(const LabelledCloud& cloud,
                                             const std::vector<std::uint32_t>& cell_of) {
  std::vector<std::uint16_t> counts(kCells);
  for (std::size_t i = 0; i < cell_of.size(); ++i) {
    if (cloud.kinds[i] != RayEnd::kBlock) continue;
    for (const std::uint32_t first : RowsAbout(cell_of[i])) {
      for (std::uint32_t cell = first; cell < first + 3; ++cell) {
        counts[cell] += counts[cell] < std::numeric_limits<std::uint16_t>::max();
      }
    }
  }
  return counts;
}

}  // namespace

DirectionGrid::DirectionGrid(const LabelledCloud& cloud) : begin_(kCells + 1) {
  const Eigen::Vector3f from_W = cloud.origins_W[0];
  std::vector<std::uint32_t> cell_of(cloud.ends_W.size());
  for (std::size_t i = 0; i < cell_of.size(); ++i) cell_of[i] = CellOf(cloud.ends_W[i] - from_W);
  objects_about_ = CountObjectPoints(cloud, cell_of);

  std::vector<std::uint32_t> near_objects;
  for (std::uint32_t i = 0; i < cell_of.size(); ++i) {
    if (objects_about_[cell_of[i]] == 0 || cloud.kinds[i] == RayEnd::kClear) continue;
    near_objects.push_back(i);
    ++begin_[cell_of[i]];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  indices_.resize(near_objects.size());
  while (!near_objects.empty()) {  // the last first: each cell's end moves to its beginning
    const std::uint32_t i = near_objects.back();
    near_objects.pop_back();
    indices_[--begin_[cell_of[i]]] = i;
  }
  for (const std::uint32_t i : indices_) {
    const Eigen::Vector3f p_m = cloud.ends_W[i] - from_W;
    cells_.push_back(cell_of[i]);
    labels_.push_back(cloud.labels[i]);
    x_m_.push_back(p_m.x());
    y_m_.push_back(p_m.y());
    z_m_.push_back(p_m.z());
    ranges_m_.push_back(std::sqrt(p_m.x() * p_m.x() + p_m.y() * p_m.y() + p_m.z() * p_m.z()));
  }
}

DirectionGrid::Votes DirectionGrid::VotesOn(std::size_t place) const {
  constexpr std::uint32_t kEnough = 5;  // the point itself among them
  const float x_m = x_m_[place], y_m = y_m_[place], z_m = z_m_[place], range_m = ranges_m_[place];
  const float apart_m = Apart_m(range_m), close_m = 0.015f * range_m + 0.1f;
  const ObjectId label = labels_[place];
  std::uint32_t fellows = 0, others = 0, close_fellows = 0, close_others = 0;
  for (const std::uint32_t first : RowsAbout(cells_[place])) {
    for (std::size_t k = begin_[first]; k < begin_[first + 3]; ++k) {
      const float dx_m = x_m_[k] - x_m, dy_m = y_m_[k] - y_m, dz_m = z_m_[k] - z_m;
      const bool is_close = dx_m * dx_m + dy_m * dy_m + dz_m * dz_m <= close_m * close_m;
      const bool as_far = std::abs(ranges_m_[k] - range_m) <= apart_m;
      const bool is_fellow = labels_[k] == label;
      fellows += as_far && is_fellow;
      others += as_far && !is_fellow;
      close_fellows += is_close && is_fellow;
      close_others += is_close && !is_fellow;
    }
  }
  if (close_fellows + close_others >= kEnough) return {close_fellows - 1, close_others};
  return {fellows - 1, others};  // without the point itself
}

bool DirectionGrid::HasFellow(std::size_t place) const {
  const float apart_m = Apart_m(ranges_m_[place]);
  for (const std::uint32_t first : RowsAbout(cells_[place])) {
    for (std::size_t k = begin_[first]; k < begin_[first + 3]; ++k) {
      if (labels_[k] == labels_[place] && std::abs(ranges_m_[k] - ranges_m_[place]) <= apart_m &&
          k != place) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace clearway
