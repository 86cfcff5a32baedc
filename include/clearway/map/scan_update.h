// What one scan says of each voxel.
#pragma once

#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_block.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// The set of voxels that a scan saw free, hit, or ended in, as bit masks per block: each voxel is
// updated at most once per scan (OctoMap's computeUpdate). Not thread-safe.
class ScanUpdate {
 public:
  struct Block {
    BlockMask free;  // traversed by a ray
    BlockMask hit;   // a ray that raises this map ended here
    BlockMask end;   // any ray ended here: traversal does not count as free
  };

  void MarkFree(BlockKey key, const BlockMask& mask) { BlockFor(key).free |= mask; }
  void MarkFree(VoxelKey key) { BlockFor(BlockOf(key)).free.Set(IndexInBlock(key)); }
  // These two tell the block's place in keys().
  std::size_t MarkHit(VoxelKey key) {
    const std::size_t place = MarkEnd(key);
    blocks_[place].hit.Set(IndexInBlock(key));
    return place;
  }
  std::size_t MarkEnd(VoxelKey key) {
    BlockFor(BlockOf(key)).end.Set(IndexInBlock(key));
    NoteEnd();
    return last_;
  }
  // Takes a hit back: a ray ended there, and that is all.
  void TakeHit(VoxelKey key) { BlockFor(BlockOf(key)).hit.Clear(IndexInBlock(key)); }
  void MarkEnd(BlockKey key, const BlockMask& mask) {
    BlockFor(key).end |= mask;
    NoteEnd();
  }

  bool Empty() const { return blocks_.empty(); }
  const Block* Find(BlockKey key) const;
  // The blocks in which something is marked, each once, in the order in which they were marked
  // first; block(i) is that of keys()[i].
  const std::vector<BlockKey>& keys() const { return keys_; }
  const Block& block(std::size_t i) const { return blocks_[i]; }
  // The places in keys() of those in which a ray ended, each once.
  const std::vector<std::size_t>& end_places() const { return end_places_; }
  void Reserve(std::size_t blocks);
  // Asks memory for the place of a block that will be marked soon.
  void Prefetch(BlockKey key) const { index_.prefetch(key); }

 private:
  Block& BlockFor(BlockKey key);
  // In the block written last.
  void NoteEnd() {
    if (has_end_[last_] != 0) return;
    has_end_[last_] = 1;
    end_places_.push_back(last_);
  }

  absl::flat_hash_map<BlockKey, std::size_t> index_;
  std::vector<BlockKey> keys_;
  std::vector<Block> blocks_;
  std::vector<char> has_end_;  // by place
  std::vector<std::size_t> end_places_;
  BlockKey last_key_;  // the block written last; rays stay in one block for several steps
  std::size_t last_ = 0;
};

}  // namespace clearway
