// Functions compiled for several processors, of which the one that runs picks its own.
#pragma once

// Before a function whose loops the compiler makes vectors of. The results are the same everywhere:
// the same operations on more values at a time. For functions local to a file: Clang 14 gives
// others a name that callers elsewhere do not know. Not with the thread sanitizer: the function
// that picks runs before the sanitizer is ready. And not with CLEARWAY_PORTABLE, by which tests see
// what other processors do.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define __SANITIZE_THREAD__ 1  // as GCC says it
#endif
#endif
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_THREAD__) && \
    !defined(CLEARWAY_PORTABLE)
#define CLEARWAY_MULTIVERSION __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CLEARWAY_MULTIVERSION
#endif
