#include "map/node_memory.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include "clearway/map/map_memory.h"
#include "map/huge_page.h"

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

// Bundles of pieces of one size, for all threads.
class Store {
 public:
  explicit Store(std::size_t node_bytes) : node_bytes_(node_bytes) {}

  void Give(const Bundle& bundle) {
    if (bundle.size == 0) return;
    std::lock_guard lock(mutex_);
    bundle.first->next_bundle = std::exchange(first_, bundle.first);
    first_->size = bundle.size;
  }
  // Throws std::bad_alloc.
  Bundle Take() {
    while (true) {
      if (const Bundle bundle = TakeIfAny(); bundle.size > 0) return bundle;
      GivePiecesOf(static_cast<std::byte*>(TakeHugePage()));
      ++pages_;
    }
  }

  void Trim() {
    std::vector<std::byte*> waiting;
    while (true) {
      Bundle bundle = TakeIfAny();
      if (bundle.size == 0) break;
      while (bundle.size > 0) waiting.push_back(reinterpret_cast<std::byte*>(bundle.Take()));
    }
    std::sort(waiting.begin(), waiting.end());
    for (auto first = waiting.begin(); first != waiting.end();) {
      const auto page = PageOf(*first);
      const auto last =
          std::find_if(first, waiting.end(), [&](auto* piece) { return PageOf(piece) != page; });
      if (static_cast<std::size_t>(last - first) == PiecesOfPage()) {
        GiveBackHugePage(reinterpret_cast<void*>(page));
        --pages_;
      } else {
        GiveAll({first, last});
      }
      first = last;
    }
  }

  std::size_t BoughtBytes() const { return pages_ * kHugePageBytes; }

 private:
  std::size_t PiecesOfPage() const { return kHugePageBytes / node_bytes_; }
  static std::uintptr_t PageOf(const std::byte* piece) {
    return reinterpret_cast<std::uintptr_t>(piece) & ~(kHugePageBytes - 1);
  }

  Bundle TakeIfAny() {
    std::lock_guard lock(mutex_);
    if (first_ == nullptr) return {};
    Piece* bundle = std::exchange(first_, first_->next_bundle);
    return {bundle, bundle->size};
  }

  void GiveAll(const std::vector<std::byte*>& pieces) {
    Bundle bundle;
    for (std::byte* piece : pieces) {
      if (bundle.size == kBundle) Give(std::exchange(bundle, {}));
      bundle.Add(new (piece) Piece);
    }
    Give(bundle);
  }

  void GivePiecesOf(std::byte* page) {
    std::vector<std::byte*> pieces(PiecesOfPage());
    for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i] = page + i * node_bytes_;
    GiveAll(pieces);
  }

  const std::size_t node_bytes_;
  std::mutex mutex_;
  Piece* first_ = nullptr;
  std::atomic<std::size_t> pages_ = 0;
};

// What a thread takes from and gives back to, so that threads seldom wait for each other: a bundle
// in use and a full or empty one, so that to take and give back in turn does not go to the store
// each time (J. Bonwick, J. Adams: Magazines and Vmem, 2001, section 3.1).
class alignas(64) Shelf {
 public:
  void* Take(Store& store) {
    std::lock_guard lock(mutex_);
    if (used_.size == 0) std::swap(used_, other_);
    if (used_.size == 0) used_ = store.Take();
    return used_.Take();
  }
  void Give(void* memory, Store& store) {
    std::lock_guard lock(mutex_);
    if (used_.size == kBundle) std::swap(used_, other_);
    if (used_.size == kBundle) store.Give(std::exchange(used_, {}));
    used_.Add(new (memory) Piece);
  }
  void Empty(Store& store) {
    std::lock_guard lock(mutex_);
    store.Give(std::exchange(used_, {}));
    store.Give(std::exchange(other_, {}));
  }

  // Pieces that were taken here less those given back here: of all shelves, those in use.
  std::atomic<std::int64_t> taken = 0;

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
class Shop {
 public:
  // Never destroyed: maps may outlive every static object.
  static Shop& The() {
    static Shop& shop = *new Shop;
    return shop;
  }

  void* Take() {
    Shelf& shelf = OwnShelf();
    void* const memory = kKept ? shelf.Take(store_) : ::operator new(kBytes, kCacheLine);
    shelf.taken.fetch_add(1, std::memory_order_relaxed);
    return memory;
  }
  void Give(void* memory) {
    Shelf& shelf = OwnShelf();
    shelf.taken.fetch_sub(1, std::memory_order_relaxed);
    kKept ? shelf.Give(memory, store_) : ::operator delete(memory, kCacheLine);
  }

  void Trim() {
    for (Shelf& shelf : shelves_) shelf.Empty(store_);
    store_.Trim();
  }
  void AddTo(MapMemory& memory) const {
    std::int64_t nodes = 0;
    for (const Shelf& shelf : shelves_) nodes += shelf.taken.load(std::memory_order_relaxed);
    const std::uint64_t bytes =
        static_cast<std::uint64_t>(std::max<std::int64_t>(nodes, 0)) * kBytes;
    memory.in_use_bytes += bytes;
    memory.waiting_bytes += std::max<std::uint64_t>(store_.BoughtBytes(), bytes) - bytes;
  }

 private:
  Shelf& OwnShelf() { return shelves_[ThreadNumber() % shelves_.size()]; }

  Store store_{kBytes};
  std::array<Shelf, 16> shelves_;
};

}  // namespace

template <std::size_t kBytes>
void* TakeNodeMemory() {
  return Shop<kBytes>::The().Take();
}

template <std::size_t kBytes>
void GiveBackNodeMemory(void* memory) {
  Shop<kBytes>::The().Give(memory);
}

MapMemory CurrentMapMemory() {
  MapMemory memory;
  Shop<kBlockMemoryBytes>::The().AddTo(memory);
  Shop<kBranchMemoryBytes>::The().AddTo(memory);
  return memory;
}

void TrimMapMemory() {
  Shop<kBlockMemoryBytes>::The().Trim();
  Shop<kBranchMemoryBytes>::The().Trim();
}

template void* TakeNodeMemory<kBlockMemoryBytes>();
template void GiveBackNodeMemory<kBlockMemoryBytes>(void*);
template void* TakeNodeMemory<kBranchMemoryBytes>();
template void GiveBackNodeMemory<kBranchMemoryBytes>(void*);

}  // namespace clearway
