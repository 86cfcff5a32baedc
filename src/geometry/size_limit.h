// How large shapes may be.
#pragma once

namespace clearway {

inline constexpr double kMaxSize_m = 100;

}  // namespace clearway
