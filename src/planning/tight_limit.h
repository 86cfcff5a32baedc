// Latest arrivals that leave little time to spare.
#pragma once

#include <algorithm>

namespace clearway {

// Whether paths that arrive within `allowed_s` are hard to find by themselves, where the straight
// way takes `straight_s`. Longer paths are easy to find, and become those when they are bettered.
inline bool IsTight(double allowed_s, double straight_s) { return allowed_s < 2 * straight_s; }

// How long those may take.
inline double LeadingSeconds(double allowed_s, double straight_s) {
  return IsTight(allowed_s, straight_s) ? std::max(allowed_s, 16 * straight_s) : allowed_s;
}

}  // namespace clearway
