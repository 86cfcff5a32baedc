// By how much the way on which an object is taken to go on may be wrong.
#pragma once

#include <functional>
#include <span>

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// How far an object of that track, whose newest pose is the last, may be from where GoesOn has it
// with that velocity.
// The object's own past tells, if it is known for long enough: how far it was, half a second and a
// second later and sooner, from where it would have been predicted (the last motion being that
// between two poses, wherever a frame's motion began). Weighed against what is usual: for the
// beginning, and for luck. Poses before `since` are no witnesses.
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
  // Root mean square, weighed against what is usual; against that the less, the more they exceed
  // it.
  double Scale_m(double usual_m) const;

 private:
  double sum_m2_ = 0;
  int count_ = 0;
};

// By how much predictions of less than half a second missed. They are known soon, and tell how far
// off the velocity was, if not how an object gains speed. What they miss has two parts: the noise
// of the poses at both ends, however short the time, and the error of the velocity, which grows
// with the time.
class SoonMisses {
 public:
  // `enough`: whether that much time tells something of the velocity by itself.
  void Add(double ahead_s, double squared_m2, bool enough);
  // Root mean square of what the velocity's error makes of that time, weighed against what is
  // usual.
  double Scale_m(double ahead_s, double usual_m) const;

 private:
  double VelocityError_m2ps2() const;

  // Sums for a straight line of squared misses over squared times ahead.
  double count_ = 0, s2_ = 0, m2_ = 0, s4_ = 0, s2m2_ = 0;
  double enough_ = 0, m2ps2_ = 0;  // of what is enough, the squared distances over squared times
};

struct PastMisses {
  Misses half, whole;  // after half a second and a whole one, of the last five
  SoonMisses soon;     // of the last second
};

// How far the object's centre was from where it would have been predicted, had that been done every
// half second (for what was missed soon, at every pose), as far as its poses since then reach back.
PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by);

// Whether these are clearly less than the others, in enough cases to be no chance.
bool IsClearlyBetter(const PastMisses& misses, const PastMisses& others);

// The bound that follows from them, of an object of that velocity. `has_motion`: of one of which
// more than a pose is known. `of_two_mended`: by its last motion, between poses that were mended
// (scene/mended_pose.h): its misses were beyond the bound too often, for reasons not looked into.
PositionBound BoundBy(const PastMisses& misses, bool has_motion, const Twist& velocity_O,
                      bool of_two_mended);

// The bound as seen from a prediction that long ahead, which is taken for a pose.
PositionBound BoundAfter(const PositionBound& bound, double seconds);

}  // namespace clearway
