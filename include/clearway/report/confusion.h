// What is said of places, against what is really there.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace clearway {

// Counts of voxels by what is really there and by what is said of them.
struct Confusion {
  enum Said { kFree, kOccupied, kUnknown };  // unknown: whatever is neither
  using Counts = std::array<std::int64_t, 3>;
  Counts truly_free{};
  Counts truly_occupied{};

  // 0 to 1; NaN of nothing.
  static double Share(const Counts& counts, Said said) {
    const std::int64_t all = counts[kFree] + counts[kOccupied] + counts[kUnknown];
    if (all == 0) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(counts[said]) / static_cast<double>(all);
  }
};

}  // namespace clearway
