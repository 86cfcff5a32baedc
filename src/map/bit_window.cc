#include "map/bit_window.h"

#include <algorithm>

namespace clearway {
namespace {

constexpr std::int64_t kMostBits = std::int64_t{1} << 29;  // 64 MB

BlockKey SizeOf(BlockKey first, BlockKey last, int multiple_x) {
  const std::int32_t x = last.x - first.x + 1;
  return {(x + multiple_x - 1) / multiple_x * multiple_x, last.y - first.y + 1,
          last.z - first.z + 1};
}

}  // namespace

bool BitWindow::Fits(BlockKey first, BlockKey last) {
  const BlockKey size = SizeOf(first, last, kBlocksPerWord);
  const std::int64_t most_blocks = kMostBits / kVoxelsPerBlock;
  return std::int64_t{size.x} * size.y <= most_blocks &&
         std::int64_t{size.x} * size.y * size.z <= most_blocks;
}

void BitWindow::Cover(BlockKey first, BlockKey last) {
  first_ = first;
  size_ = SizeOf(first, last, kBlocksPerWord);
  low_ = VoxelAt(first, 0);
  strides_ = {1, size_.x * kBlockSize, size_.x * kBlockSize * size_.y * kBlockSize};
  const std::size_t words = rows() * size_.x * kVoxelsPerBlock / 32;
  if (words_.size() < words) words_.resize(words);  // left as large as it was: new words cost time
}

bool BitWindow::AllSet(VoxelKey min, VoxelKey max) const {
  const VoxelKey end{low_.x + size_.x * kBlockSize, low_.y + size_.y * kBlockSize,
                     low_.z + size_.z * kBlockSize};
  if (min.x < low_.x || min.y < low_.y || min.z < low_.z) return false;
  if (max.x >= end.x || max.y >= end.y || max.z >= end.z) return false;
  if (max.x - min.x >= 32) {
    const VoxelKey half{min.x + 31, max.y, max.z};
    return AllSet(min, half) && AllSet({min.x + 32, min.y, min.z}, max);
  }
  const std::uint64_t ones = (std::uint64_t{2} << (max.x - min.x)) - 1;
  for (std::int32_t z = min.z; z <= max.z; ++z) {
    for (std::int32_t y = min.y; y <= max.y; ++y) {
      // The voxels along x lie in one word or two.
      const std::int32_t first = IndexOf({min.x, y, z}), last = first + max.x - min.x;
      const std::uint64_t two = words_[first >> 5] | std::uint64_t{words_[last >> 5]} << 32;
      if ((two >> (first & 31) & ones) != ones) return false;
    }
  }
  return true;
}

// The words of a line of voxels along x: line y + 8 z of the row's 64.
std::uint32_t* BitWindow::Row(std::size_t row, int line) {
  const std::int64_t y = static_cast<std::int64_t>(row) % size_.y * kBlockSize + line % kBlockSize;
  const std::int64_t z = static_cast<std::int64_t>(row) / size_.y * kBlockSize + line / kBlockSize;
  return words_.data() + (strides_[1] * y + strides_[2] * z) / 32;
}

void BitWindow::TakeRow(std::size_t row, std::vector<Block>& blocks) {
  constexpr int kLines = kBlockSize * kBlockSize;
  const std::size_t words = size_.x / kBlocksPerWord;
  any_.assign(words, 0);
  for (int line = 0; line < kLines; ++line) {
    const std::uint32_t* source = Row(row, line);
    for (std::size_t w = 0; w < words; ++w) any_[w] |= source[w];
  }
  const BlockKey row_key{first_.x, first_.y + static_cast<std::int32_t>(row % size_.y),
                         first_.z + static_cast<std::int32_t>(row / size_.y)};
  for (std::size_t w = 0; w < words; ++w) {
    if (any_[w] == 0) continue;
    std::array<BlockMask, kBlocksPerWord> masks{};
    for (int line = 0; line < kLines; ++line) {
      std::uint32_t& word = Row(row, line)[w];
      for (int b = 0; b < kBlocksPerWord; ++b) {
        masks[b].words[line / kBlockSize] |= std::uint64_t{word >> 8 * b & 0xff}
                                             << line % kBlockSize * kBlockSize;
      }
      word = 0;
    }
    for (int b = 0; b < kBlocksPerWord; ++b) {
      if ((any_[w] >> 8 * b & 0xff) == 0) continue;
      const auto x = row_key.x + static_cast<std::int32_t>(w) * kBlocksPerWord + b;
      blocks.push_back({{x, row_key.y, row_key.z}, masks[b]});
    }
  }
}

template <class Visit>
void BitWindow::ForEachLine(const Block& voxels, Visit&& visit) const {
  const std::int32_t first = IndexOf(VoxelAt(voxels.key, 0));
  for (int z = 0; z < kBlockSize; ++z) {
    const std::uint64_t layer = voxels.mask.words[z];
    if (layer == 0) continue;
    for (int y = 0; y < kBlockSize; ++y) {  // all: which have voxels, no processor could foresee
      visit(z, y, first + strides_[1] * y + strides_[2] * z,
            static_cast<std::uint32_t>(layer >> kBlockSize * y & 0xff));
    }
  }
}

void BitWindow::Clear(const Block& voxels) {
  ForEachLine(voxels, [&](int, int, std::int32_t index, std::uint32_t bits) {
    words_[index >> 5] &= ~(bits << (index & 31));
  });
}

BlockMask BitWindow::SetOf(const Block& voxels) const {
  BlockMask set;
  ForEachLine(voxels, [&](int z, int y, std::int32_t index, std::uint32_t bits) {
    set.words[z] |= std::uint64_t{words_[index >> 5] >> (index & 31) & bits} << kBlockSize * y;
  });
  return set;
}

}  // namespace clearway
