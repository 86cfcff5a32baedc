// Memory of all maps of this process.
#pragma once

#include <cstdint>

namespace clearway {

// Of blocks and branches; those that several maps share count once. A plain value.
struct MapMemory {
  std::uint64_t in_use_bytes = 0;
  std::uint64_t waiting_bytes = 0;  // given back by maps, and kept for those to come
};
// Any thread may call it; it costs less than a microsecond.
MapMemory CurrentMapMemory();

// Gives what waits back to the system, as far as whole huge pages wait. Takes time in proportion to
// what waits. Any thread may call it, while others write maps.
void TrimMapMemory();

}  // namespace clearway
