#include "map/node_memory.h"

#include <sys/mman.h>

#include <array>
#include <atomic>
#include <mutex>
#include <new>
#include <utility>

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

// Memory that waits.
struct Piece {
  Piece* next = nullptr;  // of its bundle
  // If it is the first of its bundle in the store:
  Piece* next_bundle = nullptr;
  std::size_t size = 0;
};
constexpr std::size_t kBundle = 128;  // at most in one

struct Bundle {
  Piece* first = nullptr;
  std::size_t size = 0;

  void Add(Piece* piece) {
    piece->next = first;
    first = piece;
    ++size;
  }
  Piece* Take() {
    Piece* piece = first;
    first = piece->next;
    __builtin_prefetch(first);  // to be asked for its next one
    --size;
    return piece;
  }
};

// Bundles for all threads.
class Store {
 public:
  void Give(const Bundle& bundle) {
    std::lock_guard lock(mutex_);
    bundle.first->next_bundle = std::exchange(first_, bundle.first);
    first_->size = bundle.size;
  }
  // Empty if there is none.
  Bundle Take() {
    std::lock_guard lock(mutex_);
    if (first_ == nullptr) return {};
    Piece* bundle = std::exchange(first_, first_->next_bundle);
    return {bundle, bundle->size};
  }

 private:
  std::mutex mutex_;
  Piece* first_ = nullptr;
};

// One huge page at a time, if the system has such: nodes are read and written all over a map, and
// small pages would cost a walk through the page table for each of them.
void Buy(Store& store, std::size_t node_bytes) {
  constexpr std::size_t kPageBytes = std::size_t{1} << 21;
  constexpr std::align_val_t kAlignment{kPageBytes};
  auto* memory = static_cast<std::byte*>(::operator new(kPageBytes, kAlignment));
  madvise(memory, kPageBytes, MADV_HUGEPAGE);  // else it works too
  Bundle bundle;
  for (std::size_t i = 0; i < kPageBytes / node_bytes; ++i) {
    if (bundle.size == kBundle) store.Give(std::exchange(bundle, {}));
    bundle.Add(new (memory + i * node_bytes) Piece);
  }
  store.Give(bundle);
}

// What a thread takes from and gives back to, so that threads seldom wait for each other: a bundle
// in use and a full or empty one, so that to take and give back in turn does not go to the store
// each time (J. Bonwick, J. Adams: Magazines and Vmem, 2001, section 3.1).
class alignas(64) Shelf {
 public:
  void* Take(Store& store, std::size_t node_bytes) {
    std::lock_guard lock(mutex_);
    if (used_.size == 0) std::swap(used_, other_);
    while (used_.size == 0) {
      used_ = store.Take();
      if (used_.size == 0) Buy(store, node_bytes);
    }
    return used_.Take();
  }
  void Give(void* memory, Store& store) {
    std::lock_guard lock(mutex_);
    if (used_.size == kBundle) std::swap(used_, other_);
    if (used_.size == kBundle) store.Give(std::exchange(used_, {}));
    used_.Add(new (memory) Piece);
  }

 private:
  std::mutex mutex_;  // threads may share a shelf
  Bundle used_, other_;
};

std::size_t ThreadNumber() {
  static std::atomic<std::size_t> threads = 0;
  thread_local const std::size_t number = threads++;
  return number;
}

// For nodes of one size.
template <std::size_t kBytes>
struct Shop {
  Store store;
  std::array<Shelf, 16> shelves;

  // Never destroyed: maps may outlive every static object.
  static Shop& The() {
    static Shop& shop = *new Shop;
    return shop;
  }
  Shelf& OwnShelf() { return shelves[ThreadNumber() % shelves.size()]; }
};

}  // namespace

template <std::size_t kBytes>
void* TakeNodeMemory() {
  if constexpr (!kKept) return ::operator new(kBytes, kCacheLine);
  auto& shop = Shop<kBytes>::The();
  return shop.OwnShelf().Take(shop.store, kBytes);
}

template <std::size_t kBytes>
void GiveBackNodeMemory(void* memory) {
  if constexpr (!kKept) return ::operator delete(memory, kCacheLine);
  auto& shop = Shop<kBytes>::The();
  shop.OwnShelf().Give(memory, shop.store);
}

template void* TakeNodeMemory<kBlockMemoryBytes>();
template void GiveBackNodeMemory<kBlockMemoryBytes>(void*);
template void* TakeNodeMemory<kBranchMemoryBytes>();
template void GiveBackNodeMemory<kBranchMemoryBytes>(void*);

}  // namespace clearway
