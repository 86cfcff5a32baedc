#include "map/block_update.h"

#include <array>
#include <bit>
#include <cstring>

namespace clearway {
namespace {

constexpr int kRow = kBlockSize;  // voxels along x: a byte of a mask, and a vector register

// GCC's and Clang's vectors: operators work value by value, and comparisons give all ones or 0.
using Row [[gnu::vector_size(kRow * sizeof(LogOdds))]] = LogOdds;

// For each byte, eight values that are all ones where its bit is set.
constexpr std::array<std::array<LogOdds, kRow>, 256> kRowMasks = [] {
  std::array<std::array<LogOdds, kRow>, 256> masks{};
  for (int byte = 0; byte < 256; ++byte) {
    for (int i = 0; i < kRow; ++i) masks[byte][i] = (byte >> i & 1) != 0 ? -1 : 0;
  }
  return masks;
}();

Row Load(const LogOdds* values) {
  Row row;
  std::memcpy(&row, values, sizeof(row));
  return row;
}
Row MaskOf(std::uint64_t bits) { return Load(kRowMasks[bits & 0xff].data()); }

// The sums cannot overflow, as they are clamped before they are made.
struct RowRule {
  explicit RowRule(const OccupancyModel& model)
      : miss(Row{} + model.miss),
        hit(Row{} + model.hit),
        lowest(Row{} + static_cast<LogOdds>(model.clamp_min - model.miss)),
        highest(Row{} + static_cast<LogOdds>(model.clamp_max - model.hit)) {}

  Row After(Row row, Row missed, Row raised) const {
    const Row after_miss = (row > lowest ? row : lowest) + miss;
    const Row after_hit = (row < highest ? row : highest) + hit;
    return (raised & after_hit) | (~raised & ((missed & after_miss) | (~missed & row)));
  }

  Row miss, hit, lowest, highest;
};

}  // namespace

bool ApplyScan(const ScanUpdate::Block& scan, const OccupancyModel& model, const VoxelBlock& before,
               VoxelBlock& after) {
  BlockMask misses = scan.free;
  misses.Subtract(scan.end);
  // Where the state may turn: a miss makes nothing occupied but, with a very low threshold, what it
  // is the first to observe.
  BlockMask turning = scan.hit;
  const bool seen_is_occupied = model.Occupied(model.AfterMiss(0));
  const RowRule rule(model);
  Row changes{};
  for (int z = 0; z < kBlockSize; ++z) {
    const std::uint64_t miss = misses.words[z], hit = scan.hit.words[z];
    turning.words[z] |=
        miss & (before.occupied.words[z] | (seen_is_occupied ? ~before.observed.words[z] : 0));
    after.observed.words[z] = before.observed.words[z] | miss | hit;
    for (int y = 0; y < kBlockSize; ++y) {
      const int first = (z * kBlockSize + y) * kRow;
      const Row row = Load(&before.log_odds[first]);
      const Row updated = rule.After(row, MaskOf(miss >> kRow * y), MaskOf(hit >> kRow * y));
      std::memcpy(&after.log_odds[first], &updated, sizeof(updated));
      changes |= updated ^ row;
    }
  }
  after.occupied = before.occupied;
  turning.ForEach([&](int i) {
    model.Occupied(after.log_odds[i]) ? after.occupied.Set(i) : after.occupied.Clear(i);
  });
  const auto any = std::bit_cast<std::array<std::uint64_t, 2>>(changes);
  return (any[0] | any[1]) != 0 || after.observed != before.observed;
}

}  // namespace clearway
