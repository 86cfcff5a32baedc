// For files that define functions for AVX-512, on x86-64; to be included last.
#pragma once

// GCC 12 takes the undefined registers of its own header for a fault, https://gcc.gnu.org/PR105593.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>

// On functions, not on the file: what the linker shares with other files must run everywhere.
#define CLEARWAY_AVX512 __attribute__((target("avx512f,avx512vl,avx512bw,popcnt")))
