#include "map/huge_page.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace clearway {

// Asks for twice as much and gives back what lies before and behind the page.
void* TakeHugePage() {
  void* const memory =
      mmap(nullptr, 2 * kHugePageBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  auto* const begin = static_cast<std::byte*>(memory);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(begin) % kHugePageBytes;
  std::byte* const page = begin + before;
  if (before > 0) munmap(begin, before);
  munmap(page + kHugePageBytes, kHugePageBytes - before);
  madvise(page, kHugePageBytes, MADV_HUGEPAGE);  // else it works too
  return page;
}

void GiveBackHugePage(void* page) { munmap(page, kHugePageBytes); }

}  // namespace clearway
