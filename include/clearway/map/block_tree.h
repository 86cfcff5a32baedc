// A persistent sparse array of blocks.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "clearway/base/thread_pool.h"
#include "clearway/map/voxel_block.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// Blocks by key, with O(1) copies that share memory: writing to one copy never changes another. The
// tree is a sorted list of roots (512 voxels wide) over three levels of 4x4x4 branches over the
// blocks; a write copies the blocks and branches on its path that another copy still holds. The
// same contents always have the same shape, so that two trees are compared by pointers
// (ForEachDifference).
//
// Const methods may run on any number of threads. Non-const methods need exclusive access to this
// object, but not to the copies made from it.
class BlockTree {
 public:
  // Null if there is no such block. The pointer is valid until this tree is written to or
  // destroyed.
  const VoxelBlock* Find(BlockKey key) const;

  // Find for many keys: blocks[i] is that of keys[i]. Waits for memory once for many of them.
  void FindAll(std::span<const BlockKey> keys, const VoxelBlock** blocks) const;
  // Likewise, but null too for blocks in which no voxel is occupied: it does not look into those.
  void FindOccupied(std::span<const BlockKey> keys, const VoxelBlock** blocks) const;

  // Stores the block, or removes it if nothing in it is observed.
  void Put(BlockKey key, const VoxelBlock& block);

  // Replaces many blocks, no key twice: fills `after` for keys[i] and returns whether it is to be
  // stored. Called on the pool's threads in any order; `before` is empty where there is no block,
  // and `after` may hold anything.
  using MakeBlock =
      std::function<bool(int worker, std::size_t i, const VoxelBlock& before, VoxelBlock& after)>;
  void PutAll(std::span<const BlockKey> keys, ThreadPool& pool, const MakeBlock& make);

  std::size_t size() const { return size_; }
  // Of all nodes, those shared with other copies too. Takes time in proportion to size().
  std::size_t MemoryBytes() const;

  // Calls visit(BlockKey, const VoxelBlock&) for every block; the order depends on the keys alone.
  template <class Visit>
  void ForEach(Visit&& visit) const;

  // As ForEach, as long as visit is false; returns whether it ever was true.
  template <class Visit>
  bool AnyBlock(Visit&& visit) const;

  // As ForEach, but only for the blocks whose key lies in [min, max] along each axis.
  template <class Visit>
  void ForEachIn(BlockKey min, BlockKey max, Visit&& visit) const;

  // The keys of the blocks that do not lie in [min, max], in ForEach's order. Takes time in
  // proportion to their number and to the surface of the range.
  std::vector<BlockKey> KeysOutside(BlockKey min, BlockKey max) const;

  // The blocks in [min, max] in which a voxel is occupied, as long as visit(BlockKey, const
  // VoxelBlock&) is false; returns whether it ever was true. Free space is skipped by regions.
  template <class Visit>
  bool AnyOccupiedIn(BlockKey min, BlockKey max, Visit&& visit) const;

  // Calls visit(BlockKey, const VoxelBlock* before, const VoxelBlock* after) for every block that
  // is not shared by the two trees; null where one has none. Takes time in proportion to what was
  // written between them.
  template <class Visit>
  static void ForEachDifference(const BlockTree& before, const BlockTree& after, Visit&& visit);
  // The same as long as visit is false; returns whether it ever was true.
  template <class Visit>
  static bool AnyDifference(const BlockTree& before, const BlockTree& after, Visit&& visit);

 private:
  static constexpr int kFanBits = 2;  // children along an axis: 4
  static constexpr int kFan = 64;
  static constexpr int kRootBits = 3 * kFanBits;  // a root is 64 blocks wide

  // Nodes take their memory from a store of their own.
  struct Leaf : boost::intrusive_ref_counter<Leaf> {
    static void* operator new(std::size_t bytes);
    static void operator delete(void* memory);
    alignas(64) VoxelBlock block;  // its masks: a cache line each
  };
  static void* TakeBranchMemory();
  static void GiveBackBranchMemory(void* memory);
  template <class Child>
  struct Branch : boost::intrusive_ref_counter<Branch<Child>> {
    static void* operator new(std::size_t) { return TakeBranchMemory(); }
    static void operator delete(void* memory) { GiveBackBranchMemory(memory); }
    std::uint64_t used = 0;      // the children there are
    std::uint64_t occupied = 0;  // those with an occupied voxel
    std::array<boost::intrusive_ptr<Child>, kFan> children;
  };
  using Lower = Branch<Leaf>;
  using Middle = Branch<Lower>;
  using Upper = Branch<Middle>;
  struct Root {
    BlockKey key;  // the block key shifted by kRootBits
    boost::intrusive_ptr<Upper> node;
  };

  // How many bits of a block key lie below a child of this kind of branch.
  static constexpr int ShiftBelow(const Lower*) { return 0; }
  static constexpr int ShiftBelow(const Middle*) { return kFanBits; }
  static constexpr int ShiftBelow(const Upper*) { return 2 * kFanBits; }

  static constexpr BlockKey RootKey(BlockKey key) {
    return {key.x >> kRootBits, key.y >> kRootBits, key.z >> kRootBits};
  }
  static BlockKey FirstBlockOf(const Root& root) {
    return {root.key.x << kRootBits, root.key.y << kRootBits, root.key.z << kRootBits};
  }
  static int Slot(BlockKey key, int shift) {
    return (key.x >> shift & 3) | (key.y >> shift & 3) << 2 | (key.z >> shift & 3) << 4;
  }
  // The lowest block key of a child, given that of its branch.
  static BlockKey ChildKey(BlockKey base, int slot, int shift) {
    return {base.x + ((slot & 3) << shift), base.y + ((slot >> 2 & 3) << shift),
            base.z + ((slot >> 4) << shift)};
  }

  template <class Node>
  static Node* Writable(boost::intrusive_ptr<Node>& node);
  static std::size_t BytesOf(const Leaf&) { return sizeof(Leaf); }
  template <class Child>
  static std::size_t BytesOf(const Branch<Child>& branch);
  static bool AnyOccupied(const Leaf& leaf) { return leaf.block.occupied.Any(); }
  template <class Child>
  static bool AnyOccupied(const Branch<Child>& branch) {
    return branch.occupied != 0;
  }
  using LeafPtr = boost::intrusive_ptr<Leaf>;
  // Its root must be there. Returns whether nothing remains in it.
  bool PutLeaf(BlockKey key, LeafPtr&& leaf);
  template <class Child>
  static int PutInto(boost::intrusive_ptr<Branch<Child>>& node, BlockKey key, LeafPtr&& leaf);
  static int PutInto(LeafPtr& place, BlockKey key, LeafPtr&& leaf);

  // The slots of a branch at `base` whose blocks may lie in [min, max].
  static std::uint64_t SlotsIn(BlockKey base, int shift, BlockKey min, BlockKey max);
  // Calls visit(const Root&), in the order of their keys, for the roots that may hold a block in
  // [min, max], until it returns true; returns whether it did.
  template <class Visit>
  bool AnyRootIn(BlockKey min, BlockKey max, Visit&& visit) const;
  template <bool kOccupied, class Node, class Visit>
  static bool AnyIn(const Node& node, BlockKey base, BlockKey min, BlockKey max, Visit& visit);
  template <class Node>
  static void AddKeysOutside(const Node& node, BlockKey base, BlockKey min, BlockKey max,
                             std::vector<BlockKey>& keys);
  template <class Node, class Visit>
  static bool AnyInDifference(const Node* before, const Node* after, BlockKey base, Visit& visit);

  // Where in roots_; -1 for nowhere.
  std::int32_t PlaceOfRoot(BlockKey root_key) const;
  const Upper* FindRoot(BlockKey root_key) const;
  static const Lower* LowerIn(const Upper* upper, BlockKey key);
  // leaves[i] is that of keys[i], null if there is none (with an occupied voxel).
  template <bool kOccupied>
  void FindLeaves(std::span<const BlockKey> keys, const Leaf** leaves) const;
  template <bool kOccupied>
  void FindBlocks(std::span<const BlockKey> keys, const VoxelBlock** blocks) const;
  // Roots for these root keys, of which none is there yet; some may be given twice.
  void AddRoots(std::vector<BlockKey> root_keys);
  // Those that are missing to put a leaf at its key, where there is one.
  void AddRootsFor(std::span<const BlockKey> keys, std::span<const LeafPtr> leaves);
  void RemoveEmptyRoots();
  void IndexRoots();

  std::vector<Root> roots_;  // ascending keys
  // Where a root is in roots_, -1 for nowhere: a hash table with open addressing, of a power of 2
  // entries of which at most half are used.
  std::vector<std::int32_t> root_index_;
  std::size_t size_ = 0;
};

}  // namespace clearway

#include "clearway/map/block_tree_visits.h"  // the templates
