// Memory for the nodes of all maps: their blocks and branches.
#pragma once

#include <cstddef>

namespace clearway {

// Of a block and of a branch, in whole cache lines.
inline constexpr std::size_t kBlockMemoryBytes = 1216;
inline constexpr std::size_t kBranchMemoryBytes = 576;

// Memory for one node of that size, on a cache line's border. It comes from huge pages: nodes are
// read and written all over a map, and small pages would cost a walk through the page table for
// each of them. What is given back is kept for the nodes to come, until TrimMapMemory: a scan
// replaces tens of thousands of blocks, and to be given fresh pages for them takes longer than to
// fill them. Thread-safe; any thread may give back what another took.
template <std::size_t kBytes>
void* TakeNodeMemory();
template <std::size_t kBytes>
void GiveBackNodeMemory(void* memory);

}  // namespace clearway
