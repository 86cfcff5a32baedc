// Whether a process' memory grows.
#pragma once

#include <cstdint>
#include <vector>

namespace clearway::soak {

// A plain value.
struct MemorySample {
  double at_s = 0;
  std::uint64_t bytes = 0;
};

// The slope of the least-squares line through the samples; 0 for fewer than two, or for samples of
// one instant.
double GrowthPerHour(const std::vector<MemorySample>& samples);

}  // namespace clearway::soak
