// A persistent sparse array of blocks.
#pragma once

#include <array>
#include <boost/smart_ptr/intrusive_ptr.hpp>
#include <boost/smart_ptr/intrusive_ref_counter.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

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

  // Stores the block, or removes it if nothing in it is observed.
  void Put(BlockKey key, const VoxelBlock& block);

  std::size_t size() const { return size_; }

  // Calls visit(BlockKey, const VoxelBlock&) for every block; the order depends on the keys alone.
  template <class Visit>
  void ForEach(Visit&& visit) const;

  // As ForEach, but only for the blocks whose key lies in [min, max] along each axis.
  template <class Visit>
  void ForEachIn(BlockKey min, BlockKey max, Visit&& visit) const;

  // Calls visit(BlockKey, const VoxelBlock* before, const VoxelBlock* after) for every block that
  // is not shared by the two trees; null where one has none. Takes time in proportion to what was
  // written between them.
  template <class Visit>
  static void ForEachDifference(const BlockTree& before, const BlockTree& after, Visit&& visit);

 private:
  static constexpr int kFanBits = 2;  // children along an axis: 4
  static constexpr int kFan = 64;
  static constexpr int kRootBits = 3 * kFanBits;  // a root is 64 blocks wide

  struct Leaf : boost::intrusive_ref_counter<Leaf> {
    VoxelBlock block;
  };
  template <class Child>
  struct Branch : boost::intrusive_ref_counter<Branch<Child>> {
    std::array<boost::intrusive_ptr<Child>, kFan> children;
    std::uint64_t used = 0;
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
  template <class Child>
  static int PutInto(boost::intrusive_ptr<Branch<Child>>& node, BlockKey key,
                     const VoxelBlock& block);
  static int PutInto(boost::intrusive_ptr<Leaf>& leaf, BlockKey key, const VoxelBlock& block);

  template <class Node, class Visit>
  static void VisitNode(const Node& node, BlockKey base, BlockKey min, BlockKey max, Visit& visit);
  template <class Node, class Visit>
  static void VisitDifference(const Node* before, const Node* after, BlockKey base, Visit& visit);

  std::vector<Root> roots_;  // ascending keys
  std::size_t size_ = 0;
};

template <class Node, class Visit>
void BlockTree::VisitNode(const Node& node, BlockKey base, BlockKey min, BlockKey max,
                          Visit& visit) {
  if constexpr (std::is_same_v<Node, Leaf>) {
    visit(base, node.block);
  } else {
    constexpr int shift = ShiftBelow(static_cast<const Node*>(nullptr));
    constexpr std::int32_t extent = (1 << shift) - 1;
    for (std::uint64_t used = node.used; used != 0; used &= used - 1) {
      const int slot = std::countr_zero(used);
      const BlockKey child = ChildKey(base, slot, shift);
      if (child.x > max.x || child.y > max.y || child.z > max.z || child.x + extent < min.x ||
          child.y + extent < min.y || child.z + extent < min.z) {
        continue;
      }
      VisitNode(*node.children[slot], child, min, max, visit);
    }
  }
}

template <class Visit>
void BlockTree::ForEach(Visit&& visit) const {
  constexpr std::int32_t kAll = kMaxVoxelIndex;
  ForEachIn({-kAll, -kAll, -kAll}, {kAll, kAll, kAll}, visit);
}

template <class Visit>
void BlockTree::ForEachIn(BlockKey min, BlockKey max, Visit&& visit) const {
  const BlockKey low = RootKey(min), high = RootKey(max);
  for (const Root& root : roots_) {
    if (root.key.x < low.x || root.key.y < low.y || root.key.z < low.z || root.key.x > high.x ||
        root.key.y > high.y || root.key.z > high.z) {
      continue;
    }
    const BlockKey base{root.key.x << kRootBits, root.key.y << kRootBits, root.key.z << kRootBits};
    VisitNode(*root.node, base, min, max, visit);
  }
}

template <class Node, class Visit>
void BlockTree::VisitDifference(const Node* before, const Node* after, BlockKey base,
                                Visit& visit) {
  if (before == after) return;
  if constexpr (std::is_same_v<Node, Leaf>) {
    visit(base, before ? &before->block : nullptr, after ? &after->block : nullptr);
  } else {
    constexpr int shift = ShiftBelow(static_cast<const Node*>(nullptr));
    const std::uint64_t either = (before ? before->used : 0) | (after ? after->used : 0);
    for (std::uint64_t used = either; used != 0; used &= used - 1) {
      const int slot = std::countr_zero(used);
      VisitDifference(before ? before->children[slot].get() : nullptr,
                      after ? after->children[slot].get() : nullptr, ChildKey(base, slot, shift),
                      visit);
    }
  }
}

template <class Visit>
void BlockTree::ForEachDifference(const BlockTree& before, const BlockTree& after, Visit&& visit) {
  auto b = before.roots_.begin();
  auto a = after.roots_.begin();
  while (b != before.roots_.end() || a != after.roots_.end()) {
    const bool has_b = a == after.roots_.end() || (b != before.roots_.end() && b->key <= a->key);
    const bool has_a = b == before.roots_.end() || (a != after.roots_.end() && a->key <= b->key);
    const BlockKey key = has_b ? b->key : a->key;
    VisitDifference(has_b ? b->node.get() : nullptr, has_a ? a->node.get() : nullptr,
                    BlockKey{key.x << kRootBits, key.y << kRootBits, key.z << kRootBits}, visit);
    if (has_b) ++b;
    if (has_a) ++a;
  }
}

}  // namespace clearway
