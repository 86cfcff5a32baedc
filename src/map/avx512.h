// Processors with AVX-512.
#pragma once

namespace clearway {

// Whether this processor has what the functions for AVX-512 are compiled for.
inline bool HasAvx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("popcnt");
#else
  return false;
#endif
}

}  // namespace clearway
