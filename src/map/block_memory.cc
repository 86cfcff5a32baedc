#include "map/block_memory.h"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <mutex>
#include <new>

namespace clearway {
namespace {

constexpr std::align_val_t kCacheLine{64};

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1  // as GCC says it
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kKept = false;  // so that the sanitizer sees what is used after its end
#else
constexpr bool kKept = true;
#endif

struct Piece {
  Piece* next;
};

// Pieces that wait. Threads mostly use a shelf of their own, so that they seldom wait for others.
struct alignas(64) Shelf {
  std::mutex mutex;
  Piece* first = nullptr;
};
using Shelves = std::array<Shelf, 16>;

// Never destroyed: maps may outlive every static object.
Shelves& AllShelves() {
  static Shelves& shelves = *new Shelves;
  return shelves;
}

std::size_t OwnShelf() {
  static std::atomic<std::size_t> threads = 0;
  thread_local const std::size_t shelf = threads++ % std::tuple_size_v<Shelves>;
  return shelf;
}

Piece* FirstOf(Shelf& shelf) {
  std::lock_guard lock(shelf.mutex);
  Piece* piece = shelf.first;
  if (piece != nullptr) shelf.first = piece->next;
  return piece;
}

void PutFirst(Shelf& shelf, Piece* first, Piece* last) {
  std::lock_guard lock(shelf.mutex);
  last->next = shelf.first;
  shelf.first = first;
}

// Everything that waits elsewhere on one shelf; false if there is nothing on any.
bool Fetch(Shelves& shelves, std::size_t own) {
  for (std::size_t i = 1; i < shelves.size(); ++i) {
    Shelf& other = shelves[(own + i) % shelves.size()];
    std::scoped_lock lock(shelves[own].mutex, other.mutex);
    if (shelves[own].first == nullptr) std::swap(shelves[own].first, other.first);
    if (shelves[own].first != nullptr) return true;
  }
  return false;
}

// One huge page at a time, if the system has such: blocks are read and written all over a map, and
// small pages would cost a walk through the page table for each of them.
void Buy(Shelf& shelf) {
  constexpr std::size_t kBytes = std::size_t{1} << 21;
  constexpr std::align_val_t kAlignment{kBytes};
  auto* memory = static_cast<std::byte*>(::operator new(kBytes, kAlignment));
  madvise(memory, kBytes, MADV_HUGEPAGE);  // else it works too
  Piece* first = nullptr;
  Piece* last = nullptr;
  for (std::size_t i = kBytes / kBlockMemoryBytes; i-- > 0;) {
    first = new (memory + i * kBlockMemoryBytes) Piece{first};
    if (last == nullptr) last = first;
  }
  PutFirst(shelf, first, last);
}

}  // namespace

void* TakeBlockMemory() {
  if constexpr (!kKept) return ::operator new(kBlockMemoryBytes, kCacheLine);
  Shelves& shelves = AllShelves();
  const std::size_t own = OwnShelf();
  while (true) {
    if (Piece* piece = FirstOf(shelves[own])) return piece;
    if (!Fetch(shelves, own)) Buy(shelves[own]);
  }
}

void GiveBackBlockMemory(void* memory) {
  if constexpr (!kKept) return ::operator delete(memory, kCacheLine);
  Piece* piece = new (memory) Piece{nullptr};
  PutFirst(AllShelves()[OwnShelf()], piece, piece);
}

}  // namespace clearway
