#include "scene/direction_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clearway {
namespace {

constexpr auto& RowsAbout = DirectionCells::RowsAbout;

// How much farther or nearer a neighbour may be.
float Apart_m(float range_m) { return 0.03f * range_m + 0.2f; }

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
std::vector<DirectionEntry> EntriesNearObjects(const LabelledCloud& cloud,
                                               const DirectionCells& cells) {
  const std::vector<std::uint32_t> own = OwnCells(cloud, cells);
  const std::vector<char> is_near = CellsNearObjects(cloud, cells, own);
  std::vector<DirectionEntry> entries;
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
  const std::vector<DirectionEntry> entries = EntriesNearObjects(cloud, cells);
  CountCells(entries);
  const Eigen::Vector3f from_W = cloud.origins_W[0];
  for (auto* array : {&cells_, &indices_, &filled_}) array->resize(entries.size());
  for (auto* array : {&x_m_, &y_m_, &z_m_, &ranges_m_}) array->resize(entries.size());
  is_copy_.resize(entries.size());
  labels_.resize(entries.size());
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    const auto& [cell, i, is_copy] = *entry;
    const std::size_t place = --begin_[cell - first_cell_];  // a cell's end moves to its beginning
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
  FindRanges();
}

void DirectionGrid::FindRanges() {
  std::vector<LabelRanges> own;
  std::vector<std::uint32_t> cells;  // of those with points
  for (std::size_t place = 0; place < size(); ++place) {
    if (cells.empty() || cells.back() != cells_[place]) {
      cells.push_back(cells_[place]);
      own.emplace_back();
    }
    filled_[place] = static_cast<std::uint32_t>(cells.size()) - 1;
    own.back().Add(labels_[place], ranges_m_[place]);
  }
  ranges_about_.assign(cells.size(), {});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const auto& [begin, end] : RunsAboutCell(cells[i])) {
      if (begin == end) continue;
      for (std::size_t k = filled_[begin]; k <= filled_[end - 1]; ++k) ranges_about_[i].Add(own[k]);
    }
  }
}

// Sets begin_ to the places after each cell's points, for the cells with points and those about
// them.
void DirectionGrid::CountCells(const std::vector<DirectionEntry>& entries) {
  begin_.clear();
  if (entries.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax(entries, {}, &DirectionEntry::cell);
  first_cell_ = RowsAbout(lowest.cell).front();
  begin_.resize(RowsAbout(highest.cell).back() + 4 - first_cell_);
  for (const DirectionEntry& entry : entries) ++begin_[entry.cell - first_cell_];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
}

std::array<DirectionGrid::Run, 3> DirectionGrid::RunsAboutCell(std::uint32_t cell) const {
  std::array<Run, 3> runs;
  for (std::size_t row = 0; row < runs.size(); ++row) {
    const std::uint32_t first = RowsAbout(cell)[row] - first_cell_;
    runs[row] = {begin_[first], begin_[first + 3]};
  }
  return runs;
}

bool DirectionGrid::IsSparse() const {
  constexpr std::size_t kFewest = 16, kAsked = 256;
  const std::size_t step = 1 + size() / kAsked;
  std::size_t asked = 0, found = 0;
  for (std::size_t place = 0; place < size(); place += step) {
    for (const auto& [begin, end] : RunsAbout(place)) found += end - begin;
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
  for (const auto& [begin, end] : RunsAbout(place)) {
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
  const LabelRanges& about = ranges_about_[filled_[place]];
  return about.MayHaveOther(labels_[place], range_m - apart_m, range_m + apart_m);
}

bool DirectionGrid::HasFellow(std::size_t place) const {
  const float apart_m = Apart_m(ranges_m_[place]);
  for (const auto& [begin, end] : RunsAbout(place)) {
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
