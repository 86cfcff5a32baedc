#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <map>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/base/number_text.h"
#include "clearway/io/octomap_file.h"

namespace clearway {
namespace {

// Voxels along one axis, from `first` up to `last`.
struct Span {
  std::int64_t first, last;
  std::int64_t size() const { return last - first + 1; }
};

// Which voxels of one grid those of another overlap, along one axis; both begin at 0.
class Overlaps {
 public:
  // `ratio`: the voxels' size in voxels of the other grid.
  explicit Overlaps(double ratio) : ratio_(ratio), rounding_(1e-3 * std::min(1.0, ratio)) {}

  Span Of(std::int64_t i) const {
    const double begin = static_cast<double>(i) * ratio_;
    return {static_cast<std::int64_t>(std::floor(begin + rounding_)),
            static_cast<std::int64_t>(std::ceil(begin + ratio_ - rounding_)) - 1};
  }

 private:
  double ratio_, rounding_;
};

// What is known of the voxels of an output block.
struct BlockTally {
  std::bitset<kVoxelsPerBlock> occupied;
  std::array<std::uint32_t, kVoxelsPerBlock> free = {};  // input voxels
};

class Resampler {
 public:
  Resampler(const VoxelMap& map, double resolution_m, std::int64_t max_voxels)
      : map_(map),
        resolution_m_(resolution_m),
        max_blocks_(static_cast<std::size_t>(max_voxels / kVoxelsPerBlock)),
        to_output_(map.grid().resolution_m() / resolution_m),
        to_input_(resolution_m / map.grid().resolution_m()) {}

  absl::StatusOr<VoxelMap> Run() {
    map_.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
      if (!status_.ok()) return;
      block.observed.ForEach([&](int index) {
        const VoxelKey voxel = VoxelAt(key, index);
        Add(voxel, map_.State(voxel) == VoxelState::kOccupied);
      });
    });
    if (!status_.ok()) return status_;
    VoxelMap result(resolution_m_, map_.model());
    while (!tallies_.empty()) {
      const auto first = tallies_.begin();
      Put(first->first, first->second, result);
      tallies_.erase(first);  // the result takes the memory
    }
    return result;
  }

 private:
  void Add(VoxelKey voxel, bool is_occupied) {
    const Span x = to_output_.Of(voxel.x), y = to_output_.Of(voxel.y), z = to_output_.Of(voxel.z);
    for (const Span& span : {x, y, z}) {
      if (span.first >= -kMaxVoxelIndex && span.last < kMaxVoxelIndex) continue;
      status_ = absl::OutOfRangeError(absl::StrCat("reaches beyond what voxels of ",
                                                   NumberText(resolution_m_), " m can address"));
    }
    for (std::int64_t k = z.first; k <= z.last && status_.ok(); ++k) {
      for (std::int64_t j = y.first; j <= y.last && status_.ok(); ++j) {
        for (std::int64_t i = x.first; i <= x.last && status_.ok(); ++i) {
          Mark({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j),
                static_cast<std::int32_t>(k)},
               is_occupied);
        }
      }
    }
  }

  void Mark(VoxelKey output, bool is_occupied) {
    const BlockKey key = BlockOf(output);
    if (last_ == nullptr || key != last_key_) {
      last_ = &tallies_[key];
      last_key_ = key;
      if (tallies_.size() > max_blocks_) {
        status_ = absl::ResourceExhaustedError(
            absl::StrCat("in voxels of ", NumberText(resolution_m_), " m it has more than ",
                         max_blocks_ * kVoxelsPerBlock, " voxels, the limit"));
        return;
      }
    }
    const int index = IndexInBlock(output);
    if (is_occupied) {
      last_->occupied.set(static_cast<std::size_t>(index));
    } else {
      ++last_->free[static_cast<std::size_t>(index)];
    }
  }

  void Put(BlockKey key, const BlockTally& tally, VoxelMap& result) const {
    const OccupancyModel& model = result.model();
    const VoxelKey first = VoxelAt(key, 0);
    std::array<std::int64_t, kBlockSize> x, y, z;  // input voxels along each axis
    for (int i = 0; i < kBlockSize; ++i) {
      x[i] = to_input_.Of(first.x + i).size();
      y[i] = to_input_.Of(first.y + i).size();
      z[i] = to_input_.Of(first.z + i).size();
    }
    VoxelBlock block;
    bool any = false;
    for (int i = 0; i < kVoxelsPerBlock; ++i) {
      const auto index = static_cast<std::size_t>(i);
      const VoxelKey at = VoxelAt(BlockKey(), i);  // within the block
      const std::int64_t parts = x[at.x] * y[at.y] * z[at.z];
      const bool is_free = static_cast<std::int64_t>(tally.free[index]) >= parts;
      if (!tally.occupied[index] && !is_free) continue;
      block.Set(i, tally.occupied[index] ? model.clamp_max : model.clamp_min, model);
      any = true;
    }
    if (any) result.PutBlock(key, block);
  }

  const VoxelMap& map_;
  double resolution_m_;
  std::size_t max_blocks_;
  Overlaps to_output_, to_input_;
  std::map<BlockKey, BlockTally> tallies_;
  BlockKey last_key_;
  BlockTally* last_ = nullptr;
  absl::Status status_;
};

// About how many voxels what is observed takes.
double VoxelsIn(const VoxelMap& map, double resolution_m) {
  const double ratio = map.grid().resolution_m() / resolution_m;
  return static_cast<double>(map.observed_count()) * ratio * ratio * ratio;
}

}  // namespace

absl::StatusOr<VoxelMap> Resample(const VoxelMap& map, double resolution_m,
                                  std::int64_t max_voxels) {
  if (!(resolution_m > 0) || !std::isfinite(resolution_m)) {
    return absl::InvalidArgumentError(
        absl::StrCat("resolution_m: is ", NumberText(resolution_m), "; it must be above 0"));
  }
  // Before time and memory are taken.
  const double voxels = VoxelsIn(map, resolution_m);
  if (voxels > static_cast<double>(max_voxels)) {
    return absl::ResourceExhaustedError(
        absl::StrCat("in voxels of ", NumberText(resolution_m), " m it would have about ",
                     absl::StrFormat("%.0f", voxels), " voxels; the limit is ", max_voxels));
  }
  return Resampler(map, resolution_m, max_voxels).Run();
}

}  // namespace clearway
