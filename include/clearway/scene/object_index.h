// Which moving objects may be near a place.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// The objects of a snapshot, wherever they may be in an interval of time: a query asks for those
// near a box and gets nearly all others spared. Immutable; any thread may read it.
//
// Each axis is cut into cells, and a cell holds one bit for each object that may reach into it: the
// objects near a box are those with a bit in its cells on all three axes.
class ObjectIndex {
 public:
  // Counts what an object observed, its solid, its swept bound beyond the horizon, and
  // inflation_mps times the seconds since its t_k.
  ObjectIndex(const SceneSnapshot& scene, Time first, Time last, double inflation_mps = 0);

  // Calls visit(i) for the objects scene.objects[i] that may meet the box, in ascending order;
  // there may be a few that do not.
  template <class Visit>
  void ForEachNear(const Aabb& box_W, Visit&& visit) const;

 private:
  static constexpr int kCells = 64;

  // Cells are clamped: what lies outside the objects' space meets those in the outermost cells.
  int CellOf(int axis, double coordinate) const {
    const double cell = (coordinate - low_[axis]) * cells_per_m_[axis];
    return cell <= 0 ? 0 : cell >= kCells - 1 ? kCells - 1 : static_cast<int>(cell);
  }
  std::uint64_t BitsIn(int axis, int from, int to, std::size_t word) const;

  std::size_t words_ = 0;  // per cell
  Aabb box_W_;             // around all objects
  Eigen::Vector3d low_, cells_per_m_;
  std::array<std::vector<std::uint64_t>, 3> cells_;  // word w of cell c is at c * words_ + w
};

inline std::uint64_t ObjectIndex::BitsIn(int axis, int from, int to, std::size_t word) const {
  std::uint64_t bits = 0;
  for (int cell = from; cell <= to; ++cell) bits |= cells_[axis][cell * words_ + word];
  return bits;
}

template <class Visit>
void ObjectIndex::ForEachNear(const Aabb& box_W, Visit&& visit) const {
  if (words_ == 0 || !box_W_.Intersects(box_W)) return;
  std::array<int, 3> from, to;
  for (int axis = 0; axis < 3; ++axis) {
    from[axis] = CellOf(axis, box_W.min[axis]);
    to[axis] = CellOf(axis, box_W.max[axis]);
  }
  for (std::size_t word = 0; word < words_; ++word) {
    std::uint64_t near = BitsIn(0, from[0], to[0], word);
    if (near != 0) near &= BitsIn(1, from[1], to[1], word);
    if (near != 0) near &= BitsIn(2, from[2], to[2], word);
    for (; near != 0; near &= near - 1) visit(word * 64 + std::countr_zero(near));
  }
}

}  // namespace clearway
