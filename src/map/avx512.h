// Processors with AVX-512.
#pragma once

namespace clearway {

// Whether this processor has what the functions for AVX-512 are compiled for. With
// CLEARWAY_PORTABLE never, so that tests see what other processors do.
inline bool HasAvx512() {
#if defined(__x86_64__) && !defined(CLEARWAY_PORTABLE)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("popcnt");
#else
  return false;
#endif
}

}  // namespace clearway
