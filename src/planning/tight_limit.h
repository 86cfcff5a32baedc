// Latest arrivals that leave little time to spare.
#pragma once

namespace clearway {

// How long paths may take that are looked for where they may take `allowed_s`, and the straight way
// takes `straight_s`. With little to spare they are hard to find by themselves, while longer ones
// are easy to find, and become those when they are bettered.
inline double LeadingSeconds(double allowed_s, double straight_s) {
  constexpr double kTight = 2, kLeading = 16;
  return allowed_s < kTight * straight_s ? kLeading * straight_s : allowed_s;
}

}  // namespace clearway
