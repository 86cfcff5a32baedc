#include "clearway/map/scan_update.h"

#include <algorithm>

namespace clearway {

ScanUpdate::Block& ScanUpdate::BlockFor(BlockKey key) {
  if (key != last_key_ || blocks_.empty()) {
    const auto [entry, inserted] = index_.try_emplace(key, blocks_.size());
    if (inserted) blocks_.push_back({key, {}});
    last_key_ = key;
    last_ = entry->second;
  }
  return blocks_[last_].block;
}

void ScanUpdate::Merge(const ScanUpdate& other) {
  other.ForEach([&](BlockKey key, const Block& theirs) {
    Block& mine = BlockFor(key);
    mine.free |= theirs.free;
    mine.hit |= theirs.hit;
    mine.end |= theirs.end;
  });
}

const ScanUpdate::Block* ScanUpdate::Find(BlockKey key) const {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second].block;
}

std::vector<BlockKey> ScanUpdate::SortedKeys() const {
  std::vector<BlockKey> keys;
  keys.reserve(blocks_.size());
  for (const Entry& entry : blocks_) keys.push_back(entry.key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace clearway
