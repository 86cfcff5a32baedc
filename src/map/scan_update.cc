#include "clearway/map/scan_update.h"

namespace clearway {

ScanUpdate::Block& ScanUpdate::BlockFor(BlockKey key) {
  if (key != last_key_ || blocks_.empty()) {
    const auto [entry, inserted] = index_.try_emplace(key, blocks_.size());
    if (inserted) {
      keys_.push_back(key);
      blocks_.emplace_back();
      has_end_.push_back(0);
    }
    last_key_ = key;
    last_ = entry->second;
  }
  return blocks_[last_];
}

const ScanUpdate::Block* ScanUpdate::Find(BlockKey key) const {
  const auto entry = index_.find(key);
  return entry == index_.end() ? nullptr : &blocks_[entry->second];
}

void ScanUpdate::Reserve(std::size_t blocks) {
  index_.reserve(blocks);
  keys_.reserve(blocks);
  blocks_.reserve(blocks);
  has_end_.reserve(blocks);
}

}  // namespace clearway
