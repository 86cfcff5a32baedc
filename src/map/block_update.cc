#include "map/block_update.h"

#include <algorithm>
#include <array>

namespace clearway {
namespace {

constexpr int kRow = kBlockSize;  // voxels along x: a byte of a mask, and a vector register

// For each byte, eight values that are all ones where its bit is set.
using RowMask = std::array<LogOdds, kRow>;
constexpr std::array<RowMask, 256> kRowMasks = [] {
  std::array<RowMask, 256> masks{};
  for (int byte = 0; byte < 256; ++byte) {
    for (int i = 0; i < kRow; ++i) masks[byte][i] = (byte >> i & 1) != 0 ? -1 : 0;
  }
  return masks;
}();

LogOdds Choose(LogOdds mask, LogOdds if_set, LogOdds otherwise) {
  return static_cast<LogOdds>((if_set & mask) | (otherwise & ~mask));
}

// Written for the compiler to make vectors of: no branches, nothing wider than a value. The sums
// cannot overflow, as they are clamped before they are made.
void UpdateRow(const RowMask& miss, const RowMask& hit, const OccupancyModel& model,
               LogOdds* values) {
  const auto lowest = static_cast<LogOdds>(model.clamp_min - model.miss);
  const auto highest = static_cast<LogOdds>(model.clamp_max - model.hit);
  for (int i = 0; i < kRow; ++i) {
    const auto missed = static_cast<LogOdds>(std::max(values[i], lowest) + model.miss);
    const auto raised = static_cast<LogOdds>(std::min(values[i], highest) + model.hit);
    values[i] = Choose(hit[i], raised, Choose(miss[i], missed, values[i]));
  }
}

}  // namespace

void ApplyScan(const ScanUpdate::Block& scan, const OccupancyModel& model, VoxelBlock& block) {
  BlockMask misses = scan.free;
  misses.Subtract(scan.end);
  // Where the state may turn: a miss makes nothing occupied but, with a very low threshold, what it
  // is the first to observe.
  BlockMask turning = scan.hit;
  const bool seen_is_occupied = model.Occupied(model.AfterMiss(0));
  for (int z = 0; z < kBlockSize; ++z) {
    const std::uint64_t miss = misses.words[z], hit = scan.hit.words[z];
    turning.words[z] |=
        miss & (block.occupied.words[z] | (seen_is_occupied ? ~block.observed.words[z] : 0));
    block.observed.words[z] |= miss | hit;
    for (int y = 0; y < kBlockSize; ++y) {
      const auto miss_row = miss >> kRow * y & 0xff, hit_row = hit >> kRow * y & 0xff;
      if ((miss_row | hit_row) == 0) continue;
      UpdateRow(kRowMasks[miss_row], kRowMasks[hit_row], model,
                &block.log_odds[(z * kBlockSize + y) * kRow]);
    }
  }
  turning.ForEach([&](int i) {
    model.Occupied(block.log_odds[i]) ? block.occupied.Set(i) : block.occupied.Clear(i);
  });
}

}  // namespace clearway
