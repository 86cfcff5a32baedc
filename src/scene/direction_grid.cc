#include "scene/direction_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/multiversion.h"

namespace clearway {
namespace {

// Cells on the six faces of a cube about the sensor, so many each way, of 0.9 degrees. Around each
// face is a rim of cells: in it are, once more, points of the faces beside it.
constexpr int kAcross = 100;
constexpr int kRow = kAcross + 2;
constexpr std::uint32_t kBefore = kRow + 1;  // cells that are none, so that each has neighbours
constexpr std::uint32_t kCells = 6 * kRow * kRow + 2 * kBefore;

struct Face {
  int axis;
  bool negative;
};

Face FaceOf(const Eigen::Vector3f& d) {
  int axis = std::abs(d[1]) > std::abs(d[0]) ? 1 : 0;
  if (std::abs(d[2]) > std::abs(d[axis])) axis = 2;
  return {axis, d[axis] < 0};
}

// From -1, in the rim, to kAcross, in the rim too.
struct Place {
  int u, v;
};

// From the face's middle along an axis of it.
inline int CellAlong(float slope) {
  slope = std::min(std::max(slope, -1.2f), 1.2f);
  // About 4 / pi times its arcus tangent.
  const float angle = slope + 0.3476f * slope * (1 - std::abs(slope));
  const int cell = static_cast<int>((angle + 1) * (0.5f * kAcross) + 1) - 1;  // rounded down
  return std::min(std::max(cell, -1), kAcross);
}

constexpr float kLeast_m = 1e-30f;

Place PlaceOn(Face face, const Eigen::Vector3f& d) {
  const float along = std::max(std::abs(d[face.axis]), kLeast_m);
  const auto place = [&](int axis) { return CellAlong(d[axis] / along); };
  return {place((face.axis + 1) % 3), place((face.axis + 2) % 3)};
}

std::uint32_t CellAt(Face face, Place place) {
  const int number = 2 * face.axis + static_cast<int>(face.negative);
  return kBefore + static_cast<std::uint32_t>((number * kRow + place.v + 1) * kRow + place.u + 1);
}

// Calls add(cell) for the cell that a direction lies in, on the face that it meets, and then for
// those in the rims of the faces that it just misses.
template <class Add>
void ForEachCell(const Eigen::Vector3f& d, Add&& add) {
  const Face face = FaceOf(d);
  const Place met = PlaceOn(face, d);
  const Place inside{std::clamp(met.u, 0, kAcross - 1), std::clamp(met.v, 0, kAcross - 1)};
  add(CellAt(face, inside));
  const auto add_beside = [&](int axis, int place) {
    if (place != 0 && place != kAcross - 1) return;
    const Face beside{axis, place == 0};
    add(CellAt(beside, PlaceOn(beside, d)));
  };
  add_beside((face.axis + 1) % 3, inside.u);
  add_beside((face.axis + 2) % 3, inside.v);
}

// The first of these cells, without branches: many points at a time.
inline std::uint32_t OwnCell(float x, float y, float z) {
  const float across_x = std::abs(x), across_y = std::abs(y), across_z = std::abs(z);
  const bool not_x = across_y > across_x;
  const bool on_z = across_z > (not_x ? across_y : across_x);
  const bool on_y = !on_z && not_x;
  const float main = on_z ? z : on_y ? y : x, u = on_z ? x : on_y ? z : y;
  const float v = on_z ? y : on_y ? x : z;
  const float along = std::max(std::abs(main), kLeast_m);
  const auto place = [along](float d) {
    return std::min(std::max(CellAlong(d / along), 0), kAcross - 1);
  };
  const int number = (on_z ? 4 : on_y ? 2 : 0) + (main < 0 ? 1 : 0);
  return kBefore + static_cast<std::uint32_t>((number * kRow + place(v) + 1) * kRow + place(u) + 1);
}

// The first cells of the three rows of three about a cell.
std::array<std::uint32_t, 3> RowsAbout(std::uint32_t cell) {
  return {cell - kRow - 1, cell - 1, cell + kRow - 1};
}

// How much farther or nearer a neighbour may be.
float Apart_m(float range_m) { return 0.03f * range_m + 0.2f; }

// A point of a cloud in a cell.
struct Entry {
  std::uint32_t cell, index;
  bool is_copy;  // in the rim of a face that the point is not on
};

// Of each cell, the points of objects within a cell of it.
std::vector<std::uint16_t> CountObjectPoints(const LabelledCloud& cloud) {
  std::vector<std::uint16_t> counts(kCells);
  const auto count = [&](std::uint32_t own) {
    for (const std::uint32_t first : RowsAbout(own)) {
      for (std::uint32_t cell = first; cell < first + 3; ++cell) {
        counts[cell] += counts[cell] < std::numeric_limits<std::uint16_t>::max();
      }
    }
  };
  for (std::size_t i = 0; i < cloud.ends_W.size(); ++i) {
    if (cloud.kinds[i] == RayEnd::kBlock) ForEachCell(cloud.ends_W[i] - cloud.origins_W[0], count);
  }
  return counts;
}

// The cell on the face that each point is on: the first that ForEachCell tells.
CLEARWAY_MULTIVERSION void FindOwnCells(const Eigen::Vector3f* points_W, std::size_t size,
                                        const Eigen::Vector3f& from_W, std::uint32_t* cells) {
  const float from_x = from_W.x(), from_y = from_W.y(), from_z = from_W.z();
  for (std::size_t i = 0; i < size; ++i) {
    const float* p = points_W[i].data();
    const float x = p[0] - from_x, y = p[1] - from_y, z = p[2] - from_z;
    cells[i] = OwnCell(x, y, z);
  }
}

// The points whose own cell has a point of an object within a cell of it.
std::vector<Entry> EntriesNearObjects(const LabelledCloud& cloud,
                                      const std::vector<std::uint16_t>& objects_about) {
  const Eigen::Vector3f from_W = cloud.origins_W[0];
  std::vector<std::uint32_t> own(cloud.ends_W.size());
  FindOwnCells(cloud.ends_W.data(), own.size(), from_W, own.data());
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < own.size(); ++i) {
    if (objects_about[own[i]] == 0 || cloud.kinds[i] == RayEnd::kClear) continue;
    bool is_copy = false;
    ForEachCell(cloud.ends_W[i] - from_W, [&](std::uint32_t cell) {
      entries.push_back({cell, i, is_copy});
      is_copy = true;
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

DirectionGrid::DirectionGrid(const LabelledCloud& cloud) : begin_(kCells + 1) {
  objects_about_ = CountObjectPoints(cloud);
  const std::vector<Entry> entries = EntriesNearObjects(cloud, objects_about_);
  for (const Entry& entry : entries) ++begin_[entry.cell];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<Entry> sorted(entries.size());
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    sorted[--begin_[entry->cell]] = *entry;  // each cell's end moves to its beginning
  }
  const Eigen::Vector3f from_W = cloud.origins_W[0];
  for (const auto& [cell, i, is_copy] : sorted) {
    const Eigen::Vector3f p_m = cloud.ends_W[i] - from_W;
    cells_.push_back(cell);
    indices_.push_back(i);
    is_copy_.push_back(is_copy);
    labels_.push_back(cloud.labels[i]);
    x_m_.push_back(p_m.x());
    y_m_.push_back(p_m.y());
    z_m_.push_back(p_m.z());
    ranges_m_.push_back(std::sqrt(p_m.x() * p_m.x() + p_m.y() * p_m.y() + p_m.z() * p_m.z()));
  }
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
