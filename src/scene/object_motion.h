// How an object goes on after its newest pose, and by how much that may be wrong.
#pragma once

#include <functional>
#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The velocity (in O) with which an object of that track goes on: by params.motion its last motion,
// or what fits the track, whose newest pose is the last; none if it is at rest
// (params.rest_distance_m).
Twist GoesOn(std::span<const StampedPose> track, const Twist& last_motion_O, const Solid& solid,
             const SceneParams& params);

// How far from that it may be. The object's own past tells, if it is known for long enough: how far
// it was, half a second and a second later, from where it would have been predicted (the last
// motion being that between two poses, wherever a frame's motion began). Weighed against what is
// usual: for the beginning, and for luck. Poses before `since` are no witnesses.
PositionBound BoundOf(std::span<const StampedPose> track, Time since, const Twist& velocity_O,
                      const Solid& solid, const SceneParams& params);

// How an object that was known so far, up to the last pose of the span, was taken to go on from
// there: its velocity in O.
using GoesOnBy = std::function<Twist(std::span<const StampedPose> past)>;

// Squares of distances by which predictions missed.
class Misses {
 public:
  void Add(double squared_m2) {
    sum_m2_ += squared_m2;
    ++count_;
  }
  int count() const { return count_; }
  double sum_m2() const { return sum_m2_; }
  // Root mean square, weighed against what is usual.
  double Scale_m(double usual_m) const;

 private:
  double sum_m2_ = 0;
  int count_ = 0;
};

// After half a second and a whole one.
struct PastMisses {
  Misses half, whole;
};

// How far the object's centre was from where it would have been predicted, had that been done every
// half second of the last five, as far as its poses since then reach back.
PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by);

// The bound that follows from them, of an object of that velocity. `has_motion`: of one of which
// more than a pose is known.
PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O);

// The bound as seen from a prediction that long ahead, which is taken for a pose.
PositionBound BoundAfter(const PositionBound& bound, double seconds);

}  // namespace clearway
