// The storage unit of a map: 8x8x8 voxels.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "clearway/map/occupancy_model.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

inline constexpr int kVoxelsPerBlock = 512;

// One bit per voxel of a block: bit x + 8 y of word z. A value.
struct BlockMask {
  std::array<std::uint64_t, 8> words{};

  bool Test(int index) const { return words[index >> 6] >> (index & 63) & 1; }
  void Set(int index) { words[index >> 6] |= std::uint64_t{1} << (index & 63); }
  void Clear(int index) { words[index >> 6] &= ~(std::uint64_t{1} << (index & 63)); }
  bool Any() const {
    std::uint64_t any = 0;
    for (std::uint64_t word : words) any |= word;
    return any != 0;
  }
  int Count() const {
    int count = 0;
    for (std::uint64_t word : words) count += std::popcount(word);
    return count;
  }
  // Calls visit(index) for each set bit in ascending order.
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (int z = 0; z < 8; ++z) {
      for (std::uint64_t word = words[z]; word != 0; word &= word - 1) {
        visit(z * 64 + std::countr_zero(word));
      }
    }
  }
  BlockMask& operator|=(const BlockMask& other) {
    for (int z = 0; z < 8; ++z) words[z] |= other.words[z];
    return *this;
  }
  BlockMask& operator&=(const BlockMask& other) {
    for (int z = 0; z < 8; ++z) words[z] &= other.words[z];
    return *this;
  }
  // Keeps the bits that `other` does not have.
  BlockMask& Subtract(const BlockMask& other) {
    for (int z = 0; z < 8; ++z) words[z] &= ~other.words[z];
    return *this;
  }
  bool operator==(const BlockMask&) const = default;
};

enum class VoxelState : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2 };

// Log-odds of 512 voxels with two masks. Canonical: a voxel that was never observed has log-odds 0
// and no bit, and `occupied` holds exactly the observed voxels at or above the model's threshold,
// so that equal contents are equal bytes.
struct VoxelBlock {
  BlockMask observed;
  BlockMask occupied;
  std::array<LogOdds, kVoxelsPerBlock> log_odds{};

  VoxelState State(int index) const {
    if (occupied.Test(index)) return VoxelState::kOccupied;
    return observed.Test(index) ? VoxelState::kFree : VoxelState::kUnknown;
  }
  void Set(int index, LogOdds value, const OccupancyModel& model) {
    log_odds[index] = value;
    observed.Set(index);
    model.Occupied(value) ? occupied.Set(index) : occupied.Clear(index);
  }
  void Forget(int index) {
    log_odds[index] = 0;
    observed.Clear(index);
    occupied.Clear(index);
  }
  bool operator==(const VoxelBlock&) const = default;
};

}  // namespace clearway
