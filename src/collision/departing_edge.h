// All the ways of a robot that departs within an interval, as one motion that strays.
#pragma once

#include <vector>

#include "clearway/collision/motion.h"
#include "clearway/collision/safe_intervals.h"

namespace clearway {

// An upper bound of how far any point of each link is from the link's origin. Of a ball or capsule
// it is its core that counts: turning the rest round it changes nothing.
std::vector<double> LinkReaches(const Robot& robot);

// The departure in the middle of an interval.
inline Time MiddleOf(const TimeInterval& departures) {
  return departures.from + (departures.until - departures.from) / 2;
}

// One edge of a batch whose times count from the departure. Refers to the batch.
class DepartingEdge {
 public:
  // Its knots are [first, end) of the batch, which must be valid.
  DepartingEdge(const MotionBatch& edges, std::size_t first, std::size_t end,
                const std::vector<double>& reaches_m);

  // At most, whatever is asked about such departures.
  double MostDeviation(const TimeInterval& departures) const;
  // Of who departs then.
  Time ArrivalAfter(Time departure) const { return departure + At(legs_); }
  // Appends a motion with deviations that is free only if every departure of the interval is free
  // from `since` on, which must not be after the last arrival.
  void AppendMotion(const TimeInterval& departures, Time since, MotionBatch& motions) const;
  // Appends the links' poses so long after the departure.
  void AppendPlace(Duration since_departure, std::vector<Pose>& T_W_L) const;

 private:
  // Of the legs that a robot may be on.
  struct Legs {
    std::size_t first, end;
  };
  Duration At(std::size_t knot) const { return edges_.times[first_ + knot].time_since_epoch(); }
  // The edge as who departs at `middle` goes, held at its start from when the first may depart, and
  // at its end until the last has arrived.
  MotionBatch Held(const TimeInterval& departures, Time middle) const;
  // For each of the motion's legs.
  std::vector<Legs> LegsMeanwhile(const MotionBatch& motion, Time middle, Duration apart) const;
  void SetDeviations(Time middle, Duration apart, MotionBatch& motion) const;

  const MotionBatch& edges_;
  std::size_t first_, legs_, links_;
  std::vector<double> speeds_mps_;  // of any point, at most: of link l on leg k at k * links + l
  double fastest_mps_ = 0, most_deviation_m_ = 0;
};

}  // namespace clearway
