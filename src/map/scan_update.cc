#include "clearway/map/scan_update.h"

#include <algorithm>

namespace clearway {

ScanUpdate::Block& ScanUpdate::BlockFor(VoxelKey key) {
  const BlockKey block_key = BlockOf(key);
  if (block_key != last_key_ || blocks_.empty()) {
    const auto [entry, inserted] = index_.try_emplace(block_key, blocks_.size());
    if (inserted) blocks_.emplace_back();
    last_key_ = block_key;
    last_ = entry->second;
  }
  return blocks_[last_];
}

void ScanUpdate::Merge(const ScanUpdate& other) {
  for (const auto& [key, position] : other.index_) {
    Block& mine = BlockFor(VoxelAt(key, 0));
    const Block& theirs = other.blocks_[position];
    mine.free |= theirs.free;
    mine.hit |= theirs.hit;
    mine.end |= theirs.end;
  }
}

const ScanUpdate::Block* ScanUpdate::Find(BlockKey key) const {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second];
}

std::vector<BlockKey> ScanUpdate::SortedKeys() const {
  std::vector<BlockKey> keys;
  keys.reserve(index_.size());
  for (const auto& [key, position] : index_) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace clearway
