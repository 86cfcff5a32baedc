// Which moving objects may be near a place.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A ball that goes straight, at a constant speed, from one place to another. A value.
struct MovingBall {
  Time from, until;
  Eigen::Vector3d from_W, until_W;  // its centre
  double radius_m;
};

// The objects of a snapshot, wherever they may be in an interval of time: a query asks for those
// near a box and gets nearly all others spared. Immutable; any thread may read it.
//
// The interval is cut into slices, and space along each axis into cells. A cell holds one bit for
// each object that may reach into it within a slice: the objects near a box are those with a bit in
// its cells on all three axes. For those, a ball round where the object is at the time is asked.
class ObjectIndex {
 public:
  // Counts what an object observed, its solid and its swept bound beyond the horizon. More slices
  // spare more and take longer to make.
  ObjectIndex(const SceneSnapshot& scene, Time first, Time last, int slices = 1);

  // Calls visit(i) for the objects scene.objects[i] that may meet the box at a time from `from` to
  // `until` if they are grown, in ascending order; there may be a few that do not, and more of them
  // at times outside the interval.
  template <class Visit>
  void ForEachNear(const Aabb& box_W, Time from, Time until, const ObjectGrowth& growth,
                   Visit&& visit) const;
  // The same at one time, as they are.
  template <class Visit>
  void ForEachNear(const Aabb& box_W, Time time, Visit&& visit) const {
    ForEachNear(box_W, time, time, {}, visit);
  }

  // Whether the object, grown likewise, may meet the ball on its way.
  bool MayMeet(std::size_t object, const MovingBall& ball, const ObjectGrowth& growth) const;

  // No point of any object is faster from its t_k until then, but for jumps between stated poses,
  // if objects grow meanwhile.
  double FastestMps(Time until, const ObjectGrowth& growth) const {
    return fastest_mps_ + growth.mps + growth.bound_multiple * widest_.Rate(SinceOldest(until));
  }

 private:
  static constexpr int kCells = 64;

  // One of the poses that a future is interpolated between. On its way to the next, the object's
  // origin strays from the place that it would have if it went straight.
  struct Waypoint {
    Time stamp;
    Eigen::Vector3d origin_W;
    double strays_m;             // up to the next one, as what follows
    Eigen::Vector3d velocity_W;  // of the ball's centre
    double speed_mps;
  };

  // A ball that holds an object at any time from t_k on: its centre goes straight from one waypoint
  // to the next, and from the last pose on until the horizon; the object's origin strays from it
  // as it goes along a screw.
  struct Ball {
    Time t_k;                              // growth in m/s counts from here
    std::vector<Waypoint> way;             // from t_k to the last pose; empty without a future
    Time last;                             // of the last pose
    Eigen::Vector3d origin_W, velocity_W;  // m/s, of the origin at the last pose
    double radius_m;                       // there
    double horizon_s;
    double bend_mps2;  // the origin strays by this times the square of the time
    double beyond_mps;
    PositionBound bound;  // from the last pose on

    // Where it is in the middle of a time from the last pose on, or for half of it before and
    // after. The origin is never faster than beyond the horizon.
    struct Reach {
      Eigen::Vector3d center_W;
      double radius_m;
      bool Meets(const Aabb& box_W) const {
        const Eigen::Vector3d nearest_W = center_W.cwiseMax(box_W.min).cwiseMin(box_W.max);
        return (nearest_W - center_W).squaredNorm() <= radius_m * radius_m;
      }
    };
    double Grown(Time t, const ObjectGrowth& growth) const {
      return growth.mps * std::max(0.0, ToSeconds(t - t_k)) +
             growth.bound_multiple * bound.At(ToSeconds(t - last));
    }
    Reach During(Time from, Time until, const ObjectGrowth& growth) const {
      const double half_s = 0.5 * ToSeconds(until - from);
      const double since_s = ToSeconds(from - last) + half_s;
      const double ahead_s = std::min(since_s, horizon_s);
      return {origin_W + ahead_s * velocity_W, radius_m + ahead_s * ahead_s * bend_mps2 +
                                                   (since_s - ahead_s + half_s) * beyond_mps +
                                                   Grown(until, growth)};
    }
    // The same for the part of the time that falls between waypoint `i` and the next.
    Reach DuringWay(std::size_t i, Time from, Time until, const ObjectGrowth& growth) const;
    // The waypoint from which it goes at `t`: between t_k and the last pose.
    std::size_t WaypointAt(Time t) const;
    bool MeetsOnWay(const Aabb& box_W, Time from, Time until, const ObjectGrowth& growth) const;
    // Where it is at both times, if its centre goes straight from one to the other.
    std::optional<std::array<Reach, 2>> Straight(Time from, Time until,
                                                 const ObjectGrowth& growth) const;
    bool Meets(const Aabb& box_W, Time from, Time until, const ObjectGrowth& growth) const {
      if (from < t_k) return true;
      if (from >= last) return During(from, until, growth).Meets(box_W);
      return MeetsOnWay(box_W, from, until, growth);
    }
  };

  static Ball BallOf(const MovingObject& object, Duration horizon);
  static double FastestMps(const MovingObject& object, const Ball& ball);
  static Aabb ReachOf(const MovingObject& object, const Ball& ball, Time first, Time last);
  void Mark(std::size_t object, int slice, const Aabb& reach_W);

  // Cells are clamped: what lies outside the objects' space meets those in the outermost cells.
  int CellOf(int axis, double coordinate) const {
    const double cell = (coordinate - low_[axis]) * cells_per_m_[axis];
    return cell <= 0 ? 0 : cell >= kCells - 1 ? kCells - 1 : static_cast<int>(cell);
  }
  int SliceOf(Time t) const {
    return std::min(slices_ - 1, static_cast<int>((t - first_) / slice_));
  }
  std::size_t WordOf(int slice, int cell, std::size_t word) const {
    return (static_cast<std::size_t>(slice) * kCells + cell) * words_ + word;
  }

  // The cells a query looks at.
  struct Range {
    std::array<int, 2> slices;
    std::array<std::array<int, 3>, 2> cells;  // from the first to the last on each axis
  };
  Range RangeOf(const Aabb& box_W, Time from, Time until) const;
  std::uint64_t BitsIn(const Range& range, std::size_t word) const;
  std::uint64_t AllBits(std::size_t word) const {
    const std::size_t left = balls_.size() - word * 64;
    return left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
  }

  Time first_, last_;
  Duration slice_;
  int slices_;
  std::size_t words_ = 0;  // per cell
  // Since the earliest t_k.
  double SinceOldest(Time t) const {
    return balls_.empty() ? 0 : std::max(0.0, ToSeconds(t - oldest_t_k_));
  }
  double MostGrown(Time t, const ObjectGrowth& growth) const {
    const double since_s = SinceOldest(t);
    return growth.mps * since_s + growth.bound_multiple * widest_.At(since_s);
  }

  Time oldest_t_k_ = Time::max();
  PositionBound widest_;  // at least that of each object
  Aabb box_W_;            // around all objects in the interval
  Eigen::Vector3d low_, cells_per_m_;
  std::array<std::vector<std::uint64_t>, 3> cells_;  // by WordOf
  std::vector<Ball> balls_;                          // of the objects
  double fastest_mps_ = 0;
};

inline ObjectIndex::Range ObjectIndex::RangeOf(const Aabb& box_W, Time from, Time until) const {
  Range range{{SliceOf(from), SliceOf(until)}, {}};
  for (int axis = 0; axis < 3; ++axis) {
    range.cells[0][axis] = CellOf(axis, box_W.min[axis]);
    range.cells[1][axis] = CellOf(axis, box_W.max[axis]);
  }
  return range;
}

inline std::uint64_t ObjectIndex::BitsIn(const Range& range, std::size_t word) const {
  std::uint64_t near = 0;
  for (int slice = range.slices[0]; slice <= range.slices[1]; ++slice) {
    std::uint64_t in_slice = ~std::uint64_t{0};
    for (int axis = 0; axis < 3 && in_slice != 0; ++axis) {
      std::uint64_t bits = 0;
      for (int cell = range.cells[0][axis]; cell <= range.cells[1][axis]; ++cell) {
        bits |= cells_[axis][WordOf(slice, cell, word)];
      }
      in_slice &= bits;
    }
    near |= in_slice;
  }
  return near;
}

template <class Visit>
void ObjectIndex::ForEachNear(const Aabb& box_W, Time from, Time until, const ObjectGrowth& growth,
                              Visit&& visit) const {
  if (words_ == 0) return;
  const bool within = from >= first_ && until <= last_;
  Range range{};
  if (within) {
    const Aabb grown_W = box_W.Padded(MostGrown(until, growth));
    if (!box_W_.Intersects(grown_W)) return;
    range = RangeOf(grown_W, from, until);
  }
  for (std::size_t word = 0; word < words_; ++word) {
    std::uint64_t near = within ? BitsIn(range, word) : AllBits(word);
    for (; near != 0; near &= near - 1) {
      const std::size_t object = word * 64 + std::countr_zero(near);
      if (balls_[object].Meets(box_W, from, until, growth)) visit(object);
    }
  }
}

}  // namespace clearway
