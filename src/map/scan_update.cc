#include "clearway/map/scan_update.h"

namespace clearway {

ScanUpdate::Block& ScanUpdate::BlockFor(BlockKey key) {
  if (key != last_key_ || blocks_.empty()) {
    const auto [entry, inserted] = index_.try_emplace(key, blocks_.size());
    if (inserted) {
      keys_.push_back(key);
      blocks_.emplace_back();
    }
    last_key_ = key;
    last_ = entry->second;
  }
  return blocks_[last_];
}

void ScanUpdate::Merge(const ScanUpdate& other) {
  for (std::size_t i = 0; i < other.keys_.size(); ++i) {
    const Block& theirs = other.blocks_[i];
    Block& mine = BlockFor(other.keys_[i]);
    mine.free |= theirs.free;
    mine.hit |= theirs.hit;
    mine.end |= theirs.end;
  }
}

const ScanUpdate::Block* ScanUpdate::Find(BlockKey key) const {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second];
}

void ScanUpdate::Reserve(std::size_t blocks) {
  index_.reserve(blocks);
  keys_.reserve(blocks);
  blocks_.reserve(blocks);
}

}  // namespace clearway
