// How much memory this process uses.
#pragma once

#include <cstdint>

namespace clearway {

// A plain value.
struct MemoryUse {
  std::uint64_t resident_bytes = 0;     // in memory; 0 if the kernel does not tell
  std::uint64_t heap_bytes_in_use = 0;  // handed out by malloc and not given back
};
// Any thread may call it.
MemoryUse CurrentMemoryUse();

// Has malloc keep one arena a processor (at least two), instead of glibc's eight: blocks that one
// thread takes and another frees leave holes in every arena. With eight, resident memory grew by
// 53 MB an hour in `./dev soak`, although the heap in use did not. Call it before other threads
// start.
void KeepFewArenas();

}  // namespace clearway
