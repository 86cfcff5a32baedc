// Latest arrivals, and those that leave little time to spare.
#pragma once

#include <algorithm>

#include "clearway/base/time.h"

namespace clearway {

// The limit in seconds, where the earliest arrival is then: times are whole nanoseconds, and what
// rounds to the limit is in time.
inline double LatestSeconds(Duration limit, double earliest_s) {
  const double limit_s = ToSeconds(limit);
  const bool rounds_to_it = earliest_s <= limit_s + 1 && FromSeconds(earliest_s) <= limit;
  return rounds_to_it ? std::max(limit_s, earliest_s) : limit_s;
}

// How long paths may take that are looked for where they may take `allowed_s`, and the straight way
// takes `straight_s`. With little to spare they are hard to find by themselves, while longer ones
// are easy to find, and become those when they are bettered.
inline double LeadingSeconds(double allowed_s, double straight_s) {
  constexpr double kTight = 2, kLeading = 16;
  return allowed_s < kTight * straight_s ? kLeading * straight_s : allowed_s;
}

}  // namespace clearway
