#include "clearway/map/block_tree.h"

#include <algorithm>
#include <bit>

#include "map/node_memory.h"

namespace clearway {

namespace {

void Prefetch(const void* memory, std::size_t bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(memory);  // may be 0
  for (std::size_t line = 0; line < bytes; line += 64) {
    __builtin_prefetch(reinterpret_cast<const void*>(address + line));
  }
}

// Whether both lie in one branch, `bits` bits of their keys apart.
bool Share(BlockKey a, BlockKey b, int bits) {
  return ((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) >> bits == 0;
}

std::size_t HashOf(BlockKey key) {
  const auto mix = [](std::int32_t i, std::uint32_t factor) {
    return static_cast<std::uint32_t>(i) * factor;
  };
  return mix(key.x, 73856093) ^ mix(key.y, 19349663) ^ mix(key.z, 83492791);
}

}  // namespace

void* BlockTree::Leaf::operator new(std::size_t) {
  static_assert(sizeof(Leaf) <= kBlockMemoryBytes);
  return TakeNodeMemory<kBlockMemoryBytes>();
}
void BlockTree::Leaf::operator delete(void* memory) {
  GiveBackNodeMemory<kBlockMemoryBytes>(memory);
}
void* BlockTree::TakeBranchMemory() {
  static_assert(std::max({sizeof(Lower), sizeof(Middle), sizeof(Upper)}) <= kBranchMemoryBytes);
  return TakeNodeMemory<kBranchMemoryBytes>();
}
void BlockTree::GiveBackBranchMemory(void* memory) {
  GiveBackNodeMemory<kBranchMemoryBytes>(memory);
}

void BlockTree::IndexRoots() {
  root_index_.assign(std::bit_ceil(2 * roots_.size() + 1), -1);
  const std::size_t mask = root_index_.size() - 1;
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    std::size_t place = HashOf(roots_[i].key) & mask;
    while (root_index_[place] >= 0) place = (place + 1) & mask;
    root_index_[place] = static_cast<std::int32_t>(i);
  }
}

// All at once: each moves those behind it.
void BlockTree::AddRoots(std::vector<BlockKey> root_keys) {
  if (root_keys.empty()) return;
  std::sort(root_keys.begin(), root_keys.end());
  root_keys.erase(std::unique(root_keys.begin(), root_keys.end()), root_keys.end());
  const std::size_t before = roots_.size();
  for (const BlockKey key : root_keys) roots_.push_back({key, nullptr});
  std::inplace_merge(roots_.begin(), roots_.begin() + before, roots_.end(),
                     [](const Root& a, const Root& b) { return a.key < b.key; });
  IndexRoots();
}

void BlockTree::AddRootsFor(std::span<const BlockKey> keys, std::span<const LeafPtr> leaves) {
  std::vector<BlockKey> missing;
  const BlockKey* last = nullptr;  // many in a row share a root
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (leaves[i] == nullptr || (last != nullptr && Share(*last, keys[i], kRootBits))) continue;
    last = &keys[i];
    if (PlaceOfRoot(RootKey(*last)) < 0) missing.push_back(RootKey(*last));
  }
  AddRoots(std::move(missing));
}

void BlockTree::RemoveEmptyRoots() {
  std::erase_if(roots_, [](const Root& root) { return root.node == nullptr; });
  IndexRoots();
}

std::int32_t BlockTree::PlaceOfRoot(BlockKey root_key) const {
  if (roots_.empty()) return -1;
  const std::size_t mask = root_index_.size() - 1;
  for (std::size_t place = HashOf(root_key) & mask;; place = (place + 1) & mask) {
    const std::int32_t i = root_index_[place];
    if (i < 0 || roots_[i].key == root_key) return i;
  }
}

const BlockTree::Upper* BlockTree::FindRoot(BlockKey root_key) const {
  const std::int32_t place = PlaceOfRoot(root_key);
  return place < 0 ? nullptr : roots_[place].node.get();
}

const BlockTree::Lower* BlockTree::LowerIn(const Upper* upper, BlockKey key) {
  if (upper == nullptr) return nullptr;
  const Middle* middle = upper->children[Slot(key, 2 * kFanBits)].get();
  return middle == nullptr ? nullptr : middle->children[Slot(key, kFanBits)].get();
}

const VoxelBlock* BlockTree::Find(BlockKey key) const {
  const Lower* lower = LowerIn(FindRoot(RootKey(key)), key);
  if (lower == nullptr) return nullptr;
  const Leaf* leaf = lower->children[Slot(key, 0)].get();
  return leaf == nullptr ? nullptr : &leaf->block;
}

template <bool kOccupied>
void BlockTree::FindLeaves(std::span<const BlockKey> keys, const Leaf** leaves) const {
  constexpr std::size_t kAtOnce = 64;  // memory accesses under way
  static const Lower kNone;
  static const LeafPtr kNoLeaf;
  const Upper* upper = nullptr;
  for (std::size_t begin = 0; begin < keys.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, keys.size());
    const LeafPtr* places[kAtOnce];
    const Lower* lower = nullptr;
    for (std::size_t i = begin; i < end; ++i) {
      if (i == begin || !Share(keys[i], keys[i - 1], kFanBits)) {
        if (i == 0 || !Share(keys[i], keys[i - 1], kRootBits)) upper = FindRoot(RootKey(keys[i]));
        lower = LowerIn(upper, keys[i]);
        if (lower == nullptr) lower = &kNone;
      }
      const int slot = Slot(keys[i], 0);
      const bool wanted = !kOccupied || (lower->occupied >> slot & 1) != 0;
      places[i - begin] = wanted ? &lower->children[slot] : &kNoLeaf;
      __builtin_prefetch(places[i - begin]);
    }
    for (std::size_t i = begin; i < end; ++i) leaves[i] = places[i - begin]->get();
  }
}

template <bool kOccupied>
void BlockTree::FindBlocks(std::span<const BlockKey> keys, const VoxelBlock** blocks) const {
  constexpr std::size_t kAtOnce = 256;
  const Leaf* leaves[kAtOnce];
  for (std::size_t begin = 0; begin < keys.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, keys.size() - begin);
    FindLeaves<kOccupied>(keys.subspan(begin, count), leaves);
    for (std::size_t i = 0; i < count; ++i) {
      blocks[begin + i] = leaves[i] == nullptr ? nullptr : &leaves[i]->block;
      Prefetch(blocks[begin + i], 2 * sizeof(BlockMask));
    }
  }
}

void BlockTree::FindAll(std::span<const BlockKey> keys, const VoxelBlock** blocks) const {
  FindBlocks<false>(keys, blocks);
}

void BlockTree::FindOccupied(std::span<const BlockKey> keys, const VoxelBlock** blocks) const {
  FindBlocks<true>(keys, blocks);
}

template <class Node>
void BlockTree::AddKeysOutside(const Node& node, BlockKey base, BlockKey min, BlockKey max,
                               std::vector<BlockKey>& keys) {
  if constexpr (std::is_same_v<Node, Leaf>) {
    keys.push_back(base);
  } else {
    constexpr int shift = ShiftBelow(static_cast<const Node*>(nullptr));
    for (std::uint64_t used = node.used; used != 0; used &= used - 1) {
      const int slot = std::countr_zero(used);
      const BlockKey first = ChildKey(base, slot, shift);
      constexpr std::int32_t kWidth = (1 << shift) - 1;
      const BlockKey last{first.x + kWidth, first.y + kWidth, first.z + kWidth};
      const bool inside = min.x <= first.x && last.x <= max.x && min.y <= first.y &&
                          last.y <= max.y && min.z <= first.z && last.z <= max.z;
      if (!inside) AddKeysOutside(*node.children[slot], first, min, max, keys);
    }
  }
}

std::vector<BlockKey> BlockTree::KeysOutside(BlockKey min, BlockKey max) const {
  std::vector<BlockKey> keys;
  for (const Root& root : roots_) AddKeysOutside(*root.node, FirstBlockOf(root), min, max, keys);
  return keys;
}

template <class Child>
std::size_t BlockTree::BytesOf(const Branch<Child>& branch) {
  std::size_t bytes = sizeof(branch);
  for (const auto& child : branch.children) {
    if (child != nullptr) bytes += BytesOf(*child);
  }
  return bytes;
}

std::size_t BlockTree::MemoryBytes() const {
  std::size_t bytes =
      roots_.capacity() * sizeof(Root) + root_index_.capacity() * sizeof(root_index_[0]);
  for (const Root& root : roots_) bytes += BytesOf(*root.node);
  return bytes;
}

// The node itself if this tree alone holds it, else a copy that it alone holds.
template <class Node>
Node* BlockTree::Writable(boost::intrusive_ptr<Node>& node) {
  if (node == nullptr) {
    node = new Node;
  } else if (node->use_count() != 1) {
    node = new Node(*node);
  }
  return node.get();
}

// Both return by how much the number of blocks grew, and leave a null pointer where nothing
// remains.
int BlockTree::PutInto(LeafPtr& place, BlockKey, LeafPtr&& leaf) {
  const bool existed = place != nullptr;
  const bool exists = leaf->block.observed.Any();
  place = exists ? std::move(leaf) : nullptr;
  return static_cast<int>(exists) - static_cast<int>(existed);
}

template <class Child>
int BlockTree::PutInto(boost::intrusive_ptr<Branch<Child>>& node, BlockKey key, LeafPtr&& leaf) {
  Branch<Child>* writable = Writable(node);
  const int slot = Slot(key, ShiftBelow(writable));
  boost::intrusive_ptr<Child>& child = writable->children[slot];
  const int growth = PutInto(child, key, std::move(leaf));
  const auto mark = [slot](std::uint64_t& slots, bool set) {
    slots = (slots & ~(std::uint64_t{1} << slot)) | std::uint64_t{set} << slot;
  };
  mark(writable->used, child != nullptr);
  mark(writable->occupied, child != nullptr && AnyOccupied(*child));
  if (writable->used == 0) node.reset();
  return growth;
}

bool BlockTree::PutLeaf(BlockKey key, LeafPtr&& leaf) {
  Root& root = roots_[PlaceOfRoot(RootKey(key))];
  size_ += PutInto(root.node, key, std::move(leaf));
  return root.node == nullptr;
}

void BlockTree::Put(BlockKey key, const VoxelBlock& block) {
  LeafPtr leaf = new Leaf;
  leaf->block = block;
  if (PlaceOfRoot(RootKey(key)) < 0) AddRoots({RootKey(key)});
  if (PutLeaf(key, std::move(leaf))) RemoveEmptyRoots();
}

// The blocks are made in parallel and put in their places by the caller alone. Both wait for memory
// more than for anything else: it is asked for ahead.
void BlockTree::PutAll(std::span<const BlockKey> keys, ThreadPool& pool, const MakeBlock& make) {
  static constexpr VoxelBlock kEmpty{};
  std::vector<const Leaf*> old(keys.size());
  std::vector<LeafPtr> made(keys.size());
  pool.ParallelChunks(keys.size(), 256, [&](int worker, std::size_t begin, std::size_t end) {
    FindLeaves<false>(keys.subspan(begin, end - begin), &old[begin]);
    LeafPtr leaf;
    for (std::size_t i = begin; i < end; ++i) {
      constexpr std::size_t kAhead = 2;
      if (i + kAhead < end) Prefetch(old[i + kAhead], sizeof(Leaf));
      if (leaf == nullptr) leaf = new Leaf;
      const VoxelBlock& before = old[i] == nullptr ? kEmpty : old[i]->block;
      if (make(worker, i, before, leaf->block)) made[i] = std::move(leaf);
    }
  });
  AddRootsFor(keys, made);
  bool any_empty = false;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    constexpr std::size_t kAhead = 8;
    if (i + kAhead < keys.size()) {
      Prefetch(made[i + kAhead].get(), 64 + 2 * sizeof(BlockMask));
      Prefetch(old[i + kAhead], 64);  // its count of references
    }
    if (made[i] != nullptr) any_empty |= PutLeaf(keys[i], std::move(made[i]));
  }
  if (any_empty) RemoveEmptyRoots();
}

}  // namespace clearway
