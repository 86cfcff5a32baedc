#include "server/memory_use.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "clearway/map/map_memory.h"

namespace clearway {

MemoryUse CurrentMemoryUse() {
  MemoryUse use;
  std::uint64_t pages = 0;
  // "size resident shared ...", in pages
  if (std::ifstream statm("/proc/self/statm"); statm >> pages >> pages) {
    use.resident_bytes = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  }
  const struct mallinfo2 heap = mallinfo2();
  // From arenas, mapped by themselves, and outside of malloc.
  use.heap_bytes_in_use = heap.uordblks + heap.hblkhd + CurrentMapMemory().in_use_bytes;
  return use;
}

void GiveMemoryBack() {
  TrimMapMemory();
  malloc_trim(0);
}

void KeepFewArenas() {
  const auto processors = static_cast<int>(std::thread::hardware_concurrency());
  mallopt(M_ARENA_MAX, std::max(2, processors));
}

}  // namespace clearway
