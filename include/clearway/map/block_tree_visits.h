// The templates of BlockTree: visits of its blocks. Included by block_tree.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "clearway/map/block_tree.h"

namespace clearway {

inline std::uint64_t BlockTree::SlotsIn(BlockKey base, int shift, BlockKey min, BlockKey max) {
  // For each axis the bits of the slots from `low` on and up to `high`, 0 to 3.
  const auto along = [&](std::int32_t from, std::int32_t to, std::int32_t start, int width,
                         std::uint64_t repeat) -> std::uint64_t {
    const std::int32_t low = std::max((from - start) >> shift, 0);
    const std::int32_t high = std::min((to - start) >> shift, 3);
    if (low > high) return 0;
    const std::uint64_t upto =
        high == 3 && width == 16 ? 0 : std::uint64_t{1} << width * (high + 1);
    return (upto - (std::uint64_t{1} << width * low)) * repeat;
  };
  return along(min.x, max.x, base.x, 1, 0x1111'1111'1111'1111) &
         along(min.y, max.y, base.y, 4, 0x0001'0001'0001'0001) & along(min.z, max.z, base.z, 16, 1);
}

template <bool kOccupied, class Node, class Visit>
bool BlockTree::AnyIn(const Node& node, BlockKey base, BlockKey min, BlockKey max, Visit& visit) {
  if constexpr (std::is_same_v<Node, Leaf>) {
    return visit(base, node.block);
  } else {
    constexpr int shift = ShiftBelow(static_cast<const Node*>(nullptr));
    std::uint64_t slots = (kOccupied ? node.occupied : node.used) & SlotsIn(base, shift, min, max);
    for (; slots != 0; slots &= slots - 1) {
      const int slot = std::countr_zero(slots);
      const BlockKey child = ChildKey(base, slot, shift);
      if (AnyIn<kOccupied>(*node.children[slot], child, min, max, visit)) return true;
    }
    return false;
  }
}

template <class Visit>
bool BlockTree::AnyRootIn(BlockKey min, BlockKey max, Visit&& visit) const {
  const BlockKey low = RootKey(min), high = RootKey(max);
  const auto from = [this](BlockKey key) {
    return std::lower_bound(roots_.begin(), roots_.end(), key,
                            [](const Root& r, BlockKey k) { return r.key < k; });
  };
  for (auto root = from(low); root != roots_.end() && root->key <= high;) {
    // The next key in the range, by x, then y, then z: what lies between is left out.
    BlockKey next = root->key;
    if (next.y < low.y) next = {next.x, low.y, low.z};
    if (next.y > high.y) next = {next.x + 1, low.y, low.z};
    if (next.z < low.z) next.z = low.z;
    if (next.z > high.z) next = {next.x, next.y + 1, low.z};
    if (next != root->key) {
      root = from(next);
      continue;
    }
    if (visit(*root)) return true;
    ++root;
  }
  return false;
}

template <class Visit>
void BlockTree::ForEach(Visit&& visit) const {
  constexpr std::int32_t kAll = kMaxVoxelIndex;
  ForEachIn({-kAll, -kAll, -kAll}, {kAll, kAll, kAll}, visit);
}

template <class Visit>
bool BlockTree::AnyBlock(Visit&& visit) const {
  constexpr std::int32_t kAll = kMaxVoxelIndex;
  constexpr BlockKey kMin{-kAll, -kAll, -kAll}, kMax{kAll, kAll, kAll};
  return AnyRootIn(kMin, kMax, [&](const Root& root) {
    return AnyIn<false>(*root.node, FirstBlockOf(root), kMin, kMax, visit);
  });
}

template <class Visit>
void BlockTree::ForEachIn(BlockKey min, BlockKey max, Visit&& visit) const {
  const auto every = [&](BlockKey key, const VoxelBlock& block) {
    visit(key, block);
    return false;
  };
  AnyRootIn(min, max, [&](const Root& root) {
    return AnyIn<false>(*root.node, FirstBlockOf(root), min, max, every);
  });
}

// Small ranges mostly lie in one branch: it is found without a look at its neighbours.
template <class Visit>
bool BlockTree::AnyOccupiedIn(BlockKey min, BlockKey max, Visit&& visit) const {
  const std::int32_t spread = (min.x ^ max.x) | (min.y ^ max.y) | (min.z ^ max.z);
  const auto base_of = [&](int bits) -> BlockKey {
    return {min.x >> bits << bits, min.y >> bits << bits, min.z >> bits << bits};
  };
  if (spread >> kRootBits != 0) {
    return AnyRootIn(min, max, [&](const Root& root) {
      return AnyIn<true>(*root.node, FirstBlockOf(root), min, max, visit);
    });
  }
  const Upper* upper = FindRoot(RootKey(min));
  if (upper == nullptr) return false;
  if (spread >> 2 * kFanBits != 0) return AnyIn<true>(*upper, base_of(kRootBits), min, max, visit);
  const int in_upper = Slot(min, 2 * kFanBits);
  if ((upper->occupied >> in_upper & 1) == 0) return false;
  const Middle& middle = *upper->children[in_upper];
  if (spread >> kFanBits != 0) return AnyIn<true>(middle, base_of(2 * kFanBits), min, max, visit);
  const int in_middle = Slot(min, kFanBits);
  if ((middle.occupied >> in_middle & 1) == 0) return false;
  return AnyIn<true>(*middle.children[in_middle], base_of(kFanBits), min, max, visit);
}

template <class Node, class Visit>
bool BlockTree::AnyInDifference(const Node* before, const Node* after, BlockKey base,
                                Visit& visit) {
  if (before == after) return false;
  if constexpr (std::is_same_v<Node, Leaf>) {
    return visit(base, before ? &before->block : nullptr, after ? &after->block : nullptr);
  } else {
    constexpr int shift = ShiftBelow(static_cast<const Node*>(nullptr));
    const std::uint64_t either = (before ? before->used : 0) | (after ? after->used : 0);
    for (std::uint64_t used = either; used != 0; used &= used - 1) {
      const int slot = std::countr_zero(used);
      if (AnyInDifference(before ? before->children[slot].get() : nullptr,
                          after ? after->children[slot].get() : nullptr,
                          ChildKey(base, slot, shift), visit)) {
        return true;
      }
    }
    return false;
  }
}

template <class Visit>
bool BlockTree::AnyDifference(const BlockTree& before, const BlockTree& after, Visit&& visit) {
  auto b = before.roots_.begin();
  auto a = after.roots_.begin();
  while (b != before.roots_.end() || a != after.roots_.end()) {
    const bool has_b = a == after.roots_.end() || (b != before.roots_.end() && b->key <= a->key);
    const bool has_a = b == before.roots_.end() || (a != after.roots_.end() && a->key <= b->key);
    if (AnyInDifference(has_b ? b->node.get() : nullptr, has_a ? a->node.get() : nullptr,
                        FirstBlockOf(has_b ? *b : *a), visit)) {
      return true;
    }
    if (has_b) ++b;
    if (has_a) ++a;
  }
  return false;
}

template <class Visit>
void BlockTree::ForEachDifference(const BlockTree& before, const BlockTree& after, Visit&& visit) {
  AnyDifference(before, after,
                [&](BlockKey key, const VoxelBlock* block_before, const VoxelBlock* block_after) {
                  visit(key, block_before, block_after);
                  return false;
                });
}

}  // namespace clearway
