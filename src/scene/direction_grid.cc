#include "scene/direction_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clearway {
namespace {

constexpr auto& RowsAbout = DirectionCells::RowsAbout;

// How much farther or nearer a neighbour may be.
float Apart_m(float range_m) { return 0.03f * range_m + 0.2f; }

// A point of a cloud in a cell.
struct Entry {
  std::uint32_t cell, index;
  bool is_copy;  // in the rim of a face that the point is not on
};

// The cell that each point of a cloud is in on the face that it is on.
std::vector<std::uint32_t> OwnCells(const LabelledCloud& cloud, const DirectionCells& cells) {
  std::vector<std::uint32_t> own(cloud.ends_W.size());
  cells.Find(cloud.ends_W, cloud.origins_W[0], own.data());
  return own;
}

// Whether there is a point of an object within a cell of each cell.
std::vector<char> CellsNearObjects(const LabelledCloud& cloud, const DirectionCells& cells,
                                   const std::vector<std::uint32_t>& own) {
  std::vector<char> is_near(DirectionCells::kCount);
  const auto mark = [&](std::uint32_t about) {
    for (const std::uint32_t first : RowsAbout(about)) std::fill_n(&is_near[first], 3, 1);
  };
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (cloud.kinds[i] != RayEnd::kBlock) continue;
    mark(own[i]);
    cells.ForEachInRims(own[i], cloud.ends_W[i] - cloud.origins_W[0], mark);
  }
  return is_near;
}

// The points whose own cell has a point of an object within a cell of it.
std::vector<Entry> EntriesNearObjects(const LabelledCloud& cloud, const DirectionCells& cells) {
  const std::vector<std::uint32_t> own = OwnCells(cloud, cells);
  const std::vector<char> is_near = CellsNearObjects(cloud, cells, own);
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    if (!is_near[own[i]] || cloud.kinds[i] == RayEnd::kClear) continue;
    entries.push_back({own[i], i, false});
    cells.ForEachInRims(own[i], cloud.ends_W[i] - cloud.origins_W[0], [&](std::uint32_t cell) {
      entries.push_back({cell, i, true});
    });
  }
  return entries;
}

// Of many points in a row, it is enough to look at every so manieth.
std::size_t StepOver(std::size_t points) {
  constexpr std::size_t kMany = 128, kEnough = 48;
  return points <= kMany ? 1 : (points + kEnough - 1) / kEnough;
}

}  // namespace

DirectionGrid::DirectionGrid(const LabelledCloud& cloud) {
  for (const int across : {DirectionCells::kMostAcross, 60, 40, 25}) {
    Fill(cloud, DirectionCells(across));
    if (!IsSparse()) return;
  }
}

void DirectionGrid::Fill(const LabelledCloud& cloud, const DirectionCells& cells) {
  const std::vector<Entry> entries = EntriesNearObjects(cloud, cells);
  begin_.assign(DirectionCells::kCount + 1, 0);
  for (const Entry& entry : entries) ++begin_[entry.cell];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<Entry> sorted(entries.size());
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    sorted[--begin_[entry->cell]] = *entry;  // each cell's end moves to its beginning
  }
  const Eigen::Vector3f from_W = cloud.origins_W[0];
  for (auto* array : {&cells_, &indices_}) array->resize(sorted.size());
  for (auto* array : {&x_m_, &y_m_, &z_m_, &ranges_m_}) array->resize(sorted.size());
  is_copy_.resize(sorted.size());
  labels_.resize(sorted.size());
  for (std::size_t place = 0; place < sorted.size(); ++place) {
    const auto& [cell, i, is_copy] = sorted[place];
    const Eigen::Vector3f p_m = cloud.ends_W[i] - from_W;
    cells_[place] = cell;
    indices_[place] = i;
    is_copy_[place] = is_copy;
    labels_[place] = cloud.labels[i];
    x_m_[place] = p_m.x();
    y_m_[place] = p_m.y();
    z_m_[place] = p_m.z();
    ranges_m_[place] = std::sqrt(p_m.x() * p_m.x() + p_m.y() * p_m.y() + p_m.z() * p_m.z());
  }
}

bool DirectionGrid::IsSparse() const {
  constexpr std::size_t kFewest = 16, kAsked = 256;
  const std::size_t step = 1 + size() / kAsked;
  std::size_t asked = 0, found = 0;
  for (std::size_t place = 0; place < size(); place += step) {
    for (const std::uint32_t first : RowsAbout(cells_[place])) {
      found += begin_[first + 3] - begin_[first];
    }
    ++asked;
  }
  return found < kFewest * asked;
}

DirectionGrid::Votes DirectionGrid::VotesOn(std::size_t place) const {
  constexpr std::uint32_t kEnough = 4;
  const float x_m = x_m_[place], y_m = y_m_[place], z_m = z_m_[place], range_m = ranges_m_[place];
  const float apart_m = Apart_m(range_m), close_m = 0.015f * range_m + 0.1f;
  const ObjectId label = labels_[place];
  std::uint32_t fellows = 0, others = 0, close_fellows = 0, close_others = 0;
  const auto look_at = [&](std::size_t k) {
    const float dx_m = x_m_[k] - x_m, dy_m = y_m_[k] - y_m, dz_m = z_m_[k] - z_m;
    const bool is_close = dx_m * dx_m + dy_m * dy_m + dz_m * dz_m <= close_m * close_m;
    const bool as_far = std::abs(ranges_m_[k] - range_m) <= apart_m;
    const bool is_fellow = labels_[k] == label;
    fellows += as_far && is_fellow;
    others += as_far && !is_fellow;
    close_fellows += is_close && is_fellow;
    close_others += is_close && !is_fellow;
  };
  std::uint32_t itself = 0;
  for (const std::uint32_t first : RowsAbout(cells_[place])) {
    const std::size_t begin = begin_[first], end = begin_[first + 3];
    const std::size_t step = StepOver(end - begin);
    if (step == 1) {  // most often, and many at a time
      for (std::size_t k = begin; k < end; ++k) look_at(k);
    } else {
      for (std::size_t k = begin; k < end; k += step) look_at(k);
    }
    itself += place >= begin && place < end && (place - begin) % step == 0;
  }
  fellows -= itself;
  close_fellows -= itself;
  if (close_fellows + close_others >= kEnough) return {close_fellows, close_others};
  return {fellows, others};
}

bool DirectionGrid::MayHaveOthers(std::size_t place) const {
  const float range_m = ranges_m_[place], apart_m = Apart_m(range_m);
  const ObjectId label = labels_[place];
  return std::ranges::any_of(RowsAbout(cells_[place]), [&](std::uint32_t first) {
    unsigned any = 0;  // many at a time
    for (std::size_t k = begin_[first]; k < begin_[first + 3]; ++k) {
      const bool as_far = std::abs(ranges_m_[k] - range_m) <= apart_m;
      any |= static_cast<unsigned>(labels_[k] != label) & static_cast<unsigned>(as_far);
    }
    return any != 0;
  });
}

bool DirectionGrid::HasFellow(std::size_t place) const {
  const float apart_m = Apart_m(ranges_m_[place]);
  for (const std::uint32_t first : RowsAbout(cells_[place])) {
    const std::size_t begin = begin_[first], end = begin_[first + 3];
    const std::size_t step = StepOver(end - begin);
    for (std::size_t k = begin; k < end; k += step) {
      if (labels_[k] == labels_[place] && std::abs(ranges_m_[k] - ranges_m_[place]) <= apart_m &&
          k != place) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace clearway
