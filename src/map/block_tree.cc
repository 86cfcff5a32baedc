#include "clearway/map/block_tree.h"

#include <algorithm>

namespace clearway {

const VoxelBlock* BlockTree::Find(BlockKey key) const {
  const BlockKey root_key = RootKey(key);
  const auto root = std::lower_bound(roots_.begin(), roots_.end(), root_key,
                                     [](const Root& r, BlockKey k) { return r.key < k; });
  if (root == roots_.end() || root->key != root_key) return nullptr;
  const Middle* middle = root->node->children[Slot(key, 2 * kFanBits)].get();
  if (middle == nullptr) return nullptr;
  const Lower* lower = middle->children[Slot(key, kFanBits)].get();
  if (lower == nullptr) return nullptr;
  const Leaf* leaf = lower->children[Slot(key, 0)].get();
  return leaf == nullptr ? nullptr : &leaf->block;
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
int BlockTree::PutInto(boost::intrusive_ptr<Leaf>& leaf, BlockKey, const VoxelBlock& block) {
  const bool existed = leaf != nullptr;
  const bool exists = block.observed.Any();
  if (exists) {
    if (!existed || leaf->use_count() != 1) leaf = new Leaf;  // no need to copy what is replaced
    leaf->block = block;
  } else {
    leaf.reset();
  }
  return static_cast<int>(exists) - static_cast<int>(existed);
}

template <class Child>
int BlockTree::PutInto(boost::intrusive_ptr<Branch<Child>>& node, BlockKey key,
                       const VoxelBlock& block) {
  Branch<Child>* writable = Writable(node);
  const int slot = Slot(key, ShiftBelow(writable));
  boost::intrusive_ptr<Child>& child = writable->children[slot];
  const int growth = PutInto(child, key, block);
  const std::uint64_t bit = std::uint64_t{1} << slot;
  writable->used = child != nullptr ? writable->used | bit : writable->used & ~bit;
  if (writable->used == 0) node.reset();
  return growth;
}

void BlockTree::Put(BlockKey key, const VoxelBlock& block) {
  const BlockKey root_key = RootKey(key);
  auto root = std::lower_bound(roots_.begin(), roots_.end(), root_key,
                               [](const Root& r, BlockKey k) { return r.key < k; });
  if (root == roots_.end() || root->key != root_key) {
    root = roots_.insert(root, {root_key, nullptr});
  }
  size_ += PutInto(root->node, key, block);
  if (root->node == nullptr) roots_.erase(root);
}

}  // namespace clearway
