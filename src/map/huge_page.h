// Memory from the system, 2 MiB at a time.
#pragma once

#include <cstddef>

namespace clearway {

inline constexpr std::size_t kHugePageBytes = std::size_t{1} << 21;

// One huge page, if the system has such, or as many small ones; on a huge page's border, and zero.
// Throws std::bad_alloc. Thread-safe.
void* TakeHugePage();
void GiveBackHugePage(void* page);

}  // namespace clearway
