// Memory for the blocks of all maps.
#pragma once

#include <cstddef>

namespace clearway {

// Memory for one block, on a cache line's border. What is given back is kept for the blocks to come
// and never returned to the system: a scan replaces tens of thousands of blocks, and to be given
// fresh pages for them takes longer than to fill them. Thread-safe; any thread may give back what
// another took.
inline constexpr std::size_t kBlockMemoryBytes = 1216;
void* TakeBlockMemory();
void GiveBackBlockMemory(void* memory);

}  // namespace clearway
