// How much memory this process uses.
#pragma once

#include <cstdint>

namespace clearway {

// A plain value.
struct MemoryUse {
  std::uint64_t resident_bytes = 0;  // in memory; 0 if the kernel does not tell
  // Handed out by malloc, and what maps use of their own memory (clearway/map/map_memory.h).
  std::uint64_t heap_bytes_in_use = 0;
};
// Any thread may call it.
MemoryUse CurrentMemoryUse();

// Returns to the system what the heap and the maps keep for later. Any thread may call it.
void GiveMemoryBack();

// Has malloc keep one arena a processor (at least two), instead of glibc's eight: blocks that one
// thread takes and another frees leave holes in every arena. With eight, resident memory grew by
// 53 MB an hour in `./dev soak`, although the heap in use did not. Call it before other threads
// start.
void KeepFewArenas();

}  // namespace clearway
