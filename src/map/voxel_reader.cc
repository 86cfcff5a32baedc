#include "clearway/map/voxel_reader.h"

#include "map/multiversion.h"

namespace clearway {
namespace {

constexpr VoxelBlock kUnobserved{};

CLEARWAY_MULTIVERSION
void Take(const VoxelKey* keys, std::size_t count, std::uint64_t* block_numbers,
          std::uint32_t* indices) {
  constexpr int kBits = 21;  // of a block's key along an axis, and more
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t x = keys[i].x, y = keys[i].y, z = keys[i].z;
    const auto block = [](std::uint32_t index) -> std::uint64_t {
      return index >> kBlockBits & ((1u << kBits) - 1);
    };
    block_numbers[i] = block(x) | block(y) << kBits | block(z) << 2 * kBits;
    indices[i] = (x & 7) | (y & 7) << 3 | (z & 7) << 6;
  }
}

// The state without a branch.
VoxelState StateOf(const VoxelBlock& block, int index) {
  static_assert(static_cast<int>(VoxelState::kFree) == 1);
  static_assert(static_cast<int>(VoxelState::kOccupied) == 2);
  return static_cast<VoxelState>(block.observed.Test(index) + block.occupied.Test(index));
}

}  // namespace

VoxelReader::VoxelReader(const VoxelMap& map)
    : map_(map),
      keys_(kAtOnce),
      block_numbers_(kAtOnce),
      indices_(kAtOnce),
      runs_(kAtOnce),
      members_(kAtOnce),
      block_keys_(kAtOnce),
      blocks_(kAtOnce) {}

// Fills runs_ and block_keys_; returns how many runs there are.
std::size_t VoxelReader::CutIntoRuns(std::size_t count) {
  const std::uint64_t* numbers = block_numbers_.data();
  std::uint32_t* const runs = runs_.data();
  std::uint32_t* const members = members_.data();
  std::uint32_t run = 0;
  std::uint64_t number = numbers[0];
  for (std::uint32_t i = 0; i < count; ++i) {
    run += numbers[i] != number;
    number = numbers[i];
    runs[i] = run;
    members[run] = i;
  }
  for (std::uint32_t r = 0; r <= run; ++r) block_keys_[r] = BlockOf(keys_[members[r]]);
  return run + 1;
}

void VoxelReader::Locate(std::span<const Eigen::Vector3d> points) {
  map_.grid().KeysOf(points, keys_.data());
  Take(keys_.data(), points.size(), block_numbers_.data(), indices_.data());
  const std::size_t runs = CutIntoRuns(points.size());
  map_.blocks().FindAll(std::span(block_keys_).first(runs), blocks_.data());
  std::replace(blocks_.begin(), blocks_.begin() + runs, static_cast<const VoxelBlock*>(nullptr),
               &kUnobserved);
}

void VoxelReader::States(std::span<const Eigen::Vector3d> points, std::span<VoxelState> states) {
  ForEach(points, [&](std::size_t i, const VoxelBlock& block, int index) {
    states[i] = StateOf(block, index);
  });
}

}  // namespace clearway
