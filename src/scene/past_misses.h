// How far an object's past predictions were from where it was found later.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "clearway/scene/moving_object.h"

namespace clearway {

// Predicts the velocity (in O) of an object whose poses up to the last one of the span are known.
using GoesOnBy = std::function<Twist(std::span<const StampedPose> past)>;

// Squared distances between predicted and later positions, all of about the same time ahead.
struct Misses {
  double ahead_s = 0;
  double sum_m2 = 0;
  int count = 0;

  void Add(double squared_m2) {
    sum_m2 += squared_m2;
    ++count;
  }
};

// What the poses of one object say about its predictions. A plain value.
struct PastMisses {
  // Of predictions made every half second of the last five seconds.
  std::array<Misses, 4> late = {{{0.5}, {1}, {2}, {3}}};
  // Of predictions made every tenth of a second of the last second, for less than half a second
  // ahead: known early, and quick to show that poses became noisy.
  std::vector<Misses> soon;
  // Noise of the poses over the last 1.45 s: squared distances between a pose and the straight line
  // through its neighbours.
  double jitter_m2 = 0;
  int jitter_count = 0;
  // Between the last two poses; 0 if there is only one.
  double interval_s = 0;
  // Turns the velocity at O's origin into that of the centre.
  Eigen::Vector3d center_O = Eigen::Vector3d::Zero();
};

// Replays the predictions of the object's centre by that rule. Poses before `since` are left out:
// some of them may be predictions themselves.
PastMisses MissesOf(std::span<const StampedPose> track, Time since, const Solid& solid,
                    const GoesOnBy& goes_on_by);

// Whether these are clearly smaller than the others, half a second and a second ahead, in enough
// cases to exclude chance.
bool IsClearlyBetter(const PastMisses& misses, const PastMisses& others);

}  // namespace clearway
