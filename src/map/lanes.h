// Values eight at a time.
#pragma once

#include <cstdint>

namespace clearway {

inline constexpr int kRayLanes = 8;

// GCC's and Clang's vectors: operators work value by value, and comparisons give all ones or 0.
// Aligned alike for whatever processor a function is compiled: left alone, GCC takes less for one
// without such registers. A template argument loses the alignment: no std::array of them.
using LaneFloats [[gnu::vector_size(kRayLanes * 4), gnu::aligned(kRayLanes * 4)]] = float;
using LaneDoubles [[gnu::vector_size(kRayLanes * 8), gnu::aligned(kRayLanes * 8)]] = double;
using LaneInts [[gnu::vector_size(kRayLanes * 4), gnu::aligned(kRayLanes * 4)]] = std::int32_t;

}  // namespace clearway
