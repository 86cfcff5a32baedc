#include "collision/departing_edge.h"

#include <algorithm>
#include <deque>
#include <span>
#include <variant>

#include "clearway/collision/motion_rest.h"
#include "collision/link_motion.h"

namespace clearway {
namespace {

constexpr double kRoundedBy = 1 + 1e-9;

// Points whose distances from G's origin, or from any other, no point of the shape (or of its core)
// exceeds all of.
std::vector<Eigen::Vector3d> Corners(const Shape& shape) {
  if (std::holds_alternative<Sphere>(shape)) return {Eigen::Vector3d::Zero()};
  if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    const Eigen::Vector3d end(0, 0, 0.5 * capsule->length_m);
    return {-end, end};
  }
  const Aabb box = BoundingBox(shape);
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                         (i & 4 ? box.max : box.min).z());
  }
  return corners;
}

// The largest value(i) of the indices of each range, whose firsts and ends ascend: the indices that
// may still be the largest are kept in order.
template <class Range, class Value>
std::vector<double> LargestOf(std::span<const Range> ranges, Value&& value) {
  std::vector<double> largest;
  std::deque<std::size_t> falling;
  std::size_t next = 0;
  for (const Range& range : ranges) {
    for (; next < range.end; ++next) {
      while (!falling.empty() && value(falling.back()) <= value(next)) falling.pop_back();
      falling.push_back(next);
    }
    while (falling.front() < range.first) falling.pop_front();
    largest.push_back(value(falling.front()));
  }
  return largest;
}

}  // namespace

std::vector<double> LinkReaches(const Robot& robot) {
  std::vector<double> reaches_m;
  for (const Link& link : robot.links) {
    reaches_m.push_back(0);
    for (const auto& [shape, T_L_G] : link.shapes) {
      for (const Eigen::Vector3d& corner : Corners(shape)) {
        reaches_m.back() = std::max(reaches_m.back(), (T_L_G * corner).norm());
      }
    }
  }
  return reaches_m;
}

DepartingEdge::DepartingEdge(const MotionBatch& edges, std::size_t first, std::size_t end,
                             const std::vector<double>& reaches_m)
    : edges_(edges), first_(first), legs_(end - first - 1), links_(reaches_m.size()) {
  for (std::size_t leg = 0; leg < legs_; ++leg) {
    const double lasts_s = ToSeconds(At(leg + 1) - At(leg));
    const Pose* const T_W_L = &edges.T_W_L[(first + leg) * links_];
    for (std::size_t link = 0; link < links_; ++link) {
      const LinkMotion motion(T_W_L[link], T_W_L[links_ + link], lasts_s);
      speeds_mps_.push_back(motion.speed_mps() + motion.spin_radps() * reaches_m[link]);
      fastest_mps_ = std::max(fastest_mps_, speeds_mps_.back());
      if (edges.deviations_m.empty()) continue;
      most_deviation_m_ =
          std::max(most_deviation_m_, edges.deviations_m[(first + leg) * links_ + link]);
    }
  }
}

double DepartingEdge::MostDeviation(const TimeInterval& departures) const {
  const Duration apart = departures.until - MiddleOf(departures);
  return most_deviation_m_ + kRoundedBy * fastest_mps_ * ToSeconds(apart);
}

// Let the edge be q(s) for s in [0, T], d the departure, in [a, b], m the middle, h the larger of
// b - m and m - a. At a time t, who is on the way is at q(t - d) with 0 <= t - d <= T. The motion
// asked about is at q(clamp(t - m, 0, T)), for t in [a, b + T], which is all the time that anybody
// is on the way. Clamping t - m brings it no further from anything in [0, T], so that it differs
// from t - d by at most |d - m| <= h. Between the two no point of a link goes faster than the
// fastest on the legs within h of the motion's own: it is at most h times that speed away, and
// strays from q by what it may on the leg that the robot is on, which is one of these.
//
// Who is free at all times up to `since` is so whatever the motion before then; what is left is the
// same motion from there on.
void DepartingEdge::AppendMotion(const TimeInterval& departures, Time since,
                                 MotionBatch& motions) const {
  const Time middle = MiddleOf(departures);
  const Duration apart = departures.until - middle;  // no less than middle - departures.from
  MotionBatch motion = Held(departures, middle);
  SetDeviations(middle, apart, motion);
  if (motion.times.front() < since) {
    const Time before_end = motion.times.back() - Duration(1);  // a motion takes some time
    motion = RestOf(motion, links_, std::min(since, before_end)).motions;
  }
  motions.knot_counts.push_back(motion.times.size());
  motions.times.insert(motions.times.end(), motion.times.begin(), motion.times.end());
  motions.T_W_L.insert(motions.T_W_L.end(), motion.T_W_L.begin(), motion.T_W_L.end());
  motions.deviations_m.insert(motions.deviations_m.end(), motion.deviations_m.begin(),
                              motion.deviations_m.end());
}

void DepartingEdge::AppendPlace(Duration since_departure, std::vector<Pose>& T_W_L) const {
  std::size_t leg = 0;
  while (leg + 1 < legs_ && At(leg + 1) <= since_departure) ++leg;
  const double lasts_s = ToSeconds(At(leg + 1) - At(leg));
  const double share = ToSeconds(since_departure - At(leg)) / lasts_s;
  const Pose* const from = &edges_.T_W_L[(first_ + leg) * links_];
  for (std::size_t link = 0; link < links_; ++link) {
    T_W_L.push_back(LinkMotion(from[link], from[links_ + link], lasts_s).At(share));
  }
}

MotionBatch DepartingEdge::Held(const TimeInterval& departures, Time middle) const {
  MotionBatch motion;
  const auto add = [&](Time t, std::size_t knot) {
    motion.times.push_back(t);
    const auto first = edges_.T_W_L.begin() + static_cast<std::ptrdiff_t>((first_ + knot) * links_);
    motion.T_W_L.insert(motion.T_W_L.end(), first, first + static_cast<std::ptrdiff_t>(links_));
  };
  if (departures.from < middle) add(departures.from + At(0), 0);
  for (std::size_t knot = 0; knot <= legs_; ++knot) add(middle + At(knot), knot);
  if (departures.until > middle) add(departures.until + At(legs_), legs_);
  motion.knot_counts = {motion.times.size()};
  return motion;
}

std::vector<DepartingEdge::Legs> DepartingEdge::LegsMeanwhile(const MotionBatch& motion,
                                                              Time middle, Duration apart) const {
  std::vector<Legs> meanwhile;
  Legs legs{0, 0};
  for (std::size_t k = 0; k + 1 < motion.times.size(); ++k) {
    const Duration from = motion.times[k] - middle - apart;
    const Duration until = motion.times[k + 1] - middle + apart;
    while (legs.first + 1 < legs_ && At(legs.first + 1) <= from) ++legs.first;
    while (legs.end < legs_ && At(legs.end) < until) ++legs.end;
    meanwhile.push_back(legs);
  }
  return meanwhile;
}

void DepartingEdge::SetDeviations(Time middle, Duration apart, MotionBatch& motion) const {
  const std::vector<Legs> meanwhile = LegsMeanwhile(motion, middle, apart);
  motion.deviations_m.assign(motion.T_W_L.size(), 0);  // those of the last knot do not matter
  for (std::size_t link = 0; link < links_; ++link) {
    const auto speeds_mps = LargestOf(
        std::span(meanwhile), [&](std::size_t leg) { return speeds_mps_[leg * links_ + link]; });
    const auto strays_m = LargestOf(std::span(meanwhile), [&](std::size_t leg) {
      return edges_.deviations_m.empty() ? 0 : edges_.deviations_m[(first_ + leg) * links_ + link];
    });
    for (std::size_t leg = 0; leg < meanwhile.size(); ++leg) {
      motion.deviations_m[leg * links_ + link] =
          strays_m[leg] + kRoundedBy * speeds_mps[leg] * ToSeconds(apart);
    }
  }
}

}  // namespace clearway
