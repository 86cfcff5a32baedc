// Which moving objects may be near a place.
#pragma once

#include <algorithm>
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
// objects near a box are those with a bit in its cells on all three axes. For those, a ball round
// where the object is at the time is asked.
class ObjectIndex {
 public:
  // Counts what an object observed, its solid, its swept bound beyond the horizon, and
  // inflation_mps times the seconds since its t_k.
  ObjectIndex(const SceneSnapshot& scene, Time first, Time last, double inflation_mps = 0);

  // Calls visit(i) for the objects scene.objects[i] that may meet the box at `time`, which lies in
  // the interval, in ascending order; there may be a few that do not.
  template <class Visit>
  void ForEachNear(const Aabb& box_W, Time time, Visit&& visit) const {
    ForEachNear(box_W, time, time, visit);
  }
  // The same for all times from `from` to `until`, which both lie in the interval.
  template <class Visit>
  void ForEachNear(const Aabb& box_W, Time from, Time until, Visit&& visit) const;

 private:
  static constexpr int kCells = 64;

  // Cells are clamped: what lies outside the objects' space meets those in the outermost cells.
  int CellOf(int axis, double coordinate) const {
    const double cell = (coordinate - low_[axis]) * cells_per_m_[axis];
    return cell <= 0 ? 0 : cell >= kCells - 1 ? kCells - 1 : static_cast<int>(cell);
  }
  std::uint64_t BitsIn(int axis, int from, int to, std::size_t word) const;

  // A ball that holds an object at any time from t_k on: its centre goes straight on until the
  // horizon, from which the object's origin strays as it goes along a screw.
  struct Ball {
    Time t_k;
    Eigen::Vector3d origin_W, velocity_W;  // m/s, of the origin at t_k
    double radius_m;                       // at t_k
    double horizon_s;
    double bend_mps2;  // the origin strays by this times the square of the time
    double beyond_mps, inflation_mps;

    // In the middle of a time, or for half of it before and after. The origin is never faster
    // than beyond the horizon.
    bool Meets(const Aabb& box_W, Time from, Time until) const {
      if (from < t_k) return true;
      const double half_s = 0.5 * ToSeconds(until - from);
      const double since_s = ToSeconds(from - t_k) + half_s;
      const double ahead_s = std::min(since_s, horizon_s);
      const Eigen::Vector3d center_W = origin_W + ahead_s * velocity_W;
      const double reach_m = radius_m + ahead_s * ahead_s * bend_mps2 +
                             (since_s - ahead_s + half_s) * beyond_mps +
                             (since_s + half_s) * inflation_mps;
      const Eigen::Vector3d nearest_W = center_W.cwiseMax(box_W.min).cwiseMin(box_W.max);
      return (nearest_W - center_W).squaredNorm() <= reach_m * reach_m;
    }
  };
  static Ball BallOf(const MovingObject& object, Duration horizon, double inflation_mps);

  std::size_t words_ = 0;  // per cell
  Aabb box_W_;             // around all objects
  Eigen::Vector3d low_, cells_per_m_;
  std::array<std::vector<std::uint64_t>, 3> cells_;  // word w of cell c is at c * words_ + w
  std::vector<Ball> balls_;                          // of the objects
};

inline std::uint64_t ObjectIndex::BitsIn(int axis, int from, int to, std::size_t word) const {
  std::uint64_t bits = 0;
  for (int cell = from; cell <= to; ++cell) bits |= cells_[axis][cell * words_ + word];
  return bits;
}

template <class Visit>
void ObjectIndex::ForEachNear(const Aabb& box_W, Time from, Time until, Visit&& visit) const {
  if (words_ == 0 || !box_W_.Intersects(box_W)) return;
  std::array<int, 3> first, last;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = CellOf(axis, box_W.min[axis]);
    last[axis] = CellOf(axis, box_W.max[axis]);
  }
  for (std::size_t word = 0; word < words_; ++word) {
    std::uint64_t near = BitsIn(0, first[0], last[0], word);
    if (near != 0) near &= BitsIn(1, first[1], last[1], word);
    if (near != 0) near &= BitsIn(2, first[2], last[2], word);
    for (; near != 0; near &= near - 1) {
      const std::size_t object = word * 64 + std::countr_zero(near);
      if (balls_[object].Meets(box_W, from, until)) visit(object);
    }
  }
}

}  // namespace clearway
