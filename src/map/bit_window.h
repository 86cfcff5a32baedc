// A part of the grid as a dense array of bits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "clearway/map/voxel_block.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// One bit for each voxel of a box of blocks, x fastest, so that a step to a neighbouring voxel is
// one addition to the index of the bit. One thread at a time.
class BitWindow {
 public:
  // Whether a window from block `first` to block `last` is small enough to be worth its memory.
  static bool Fits(BlockKey first, BlockKey last);

  // Takes the blocks [first, last], which must fit. Bits that were set before are set still, and no
  // one knows where; if all were taken, all are clear. Memory is kept from before.
  void Cover(BlockKey first, BlockKey last);

  std::int32_t IndexOf(VoxelKey key) const {
    return key.x - low_.x + strides_[1] * (key.y - low_.y) + strides_[2] * (key.z - low_.z);
  }
  // The voxel of index 0.
  VoxelKey low() const { return low_; }
  // What a step along x, y and z adds to an index.
  const std::array<std::int32_t, 3>& strides() const { return strides_; }
  // Bit i is bit i % 32 of word i / 32.
  std::uint32_t* words() { return words_.data(); }

  bool Test(VoxelKey key) const { return words_[IndexOf(key) >> 5] >> (IndexOf(key) & 31) & 1; }
  void Set(VoxelKey key) { words_[IndexOf(key) >> 5] |= std::uint32_t{1} << (IndexOf(key) & 31); }

  // Whether all voxels from `min` to `max` are set; false if one of them lies outside the window.
  bool AllSet(VoxelKey min, VoxelKey max) const;

  // Rows of blocks along x.
  std::size_t rows() const { return static_cast<std::size_t>(size_.y) * size_.z; }
  // Adds the blocks of row `row` in which a bit is set, and clears them.
  struct Block {
    BlockKey key;
    BlockMask mask;
  };
  void TakeRow(std::size_t row, std::vector<Block>& blocks);

  // Of some voxels of a block of the window: clears them, and tells which are set.
  void Clear(const Block& voxels);
  BlockMask SetOf(const Block& voxels) const;

 private:
  static constexpr int kBlocksPerWord = 32 / kBlockSize;

  std::uint32_t* Row(std::size_t row, int line);
  // Calls visit(z, y, index, bits) for the lines along x of the block's layers in which some of the
  // voxels lie: the index of its first voxel, and which of its eight they are. A line lies in one
  // word.
  template <class Visit>
  void ForEachLine(const Block& voxels, Visit&& visit) const;

  BlockKey first_;
  BlockKey size_;  // in blocks; along x a multiple of kBlocksPerWord
  VoxelKey low_;
  std::array<std::int32_t, 3> strides_{};
  std::vector<std::uint32_t> words_;
  std::vector<std::uint32_t> any_;  // of a row's lines, by TakeRow
};

}  // namespace clearway
