// Values eight at a time.
#pragma once

#include <cstdint>

namespace clearway {

inline constexpr int kLanes = 8;

// GCC's and Clang's vectors: operators work value by value, and comparisons give all ones or 0.
// Aligned alike for whatever processor a function is compiled: left alone, GCC takes less for one
// without such registers. A template argument loses the alignment: no std::array of them.
using LaneFloats [[gnu::vector_size(kLanes * 4), gnu::aligned(kLanes * 4)]] = float;
using LaneDoubles [[gnu::vector_size(kLanes * 8), gnu::aligned(kLanes * 8)]] = double;
using LaneInts [[gnu::vector_size(kLanes * 4), gnu::aligned(kLanes * 4)]] = std::int32_t;
using LaneLongs [[gnu::vector_size(kLanes * 8), gnu::aligned(kLanes * 8)]] = std::int64_t;

}  // namespace clearway
