#include "scene/map_delta.h"

#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr VoxelBlock kEmptyBlock{};

// The voxels with other log-odds, as bits.
BlockMask OtherLogOdds(const VoxelBlock& before, const VoxelBlock& after) {
  BlockMask other;
  for (int z = 0; z < 8; ++z) {
    const LogOdds* a = before.log_odds.data() + 64 * z;
    const LogOdds* b = after.log_odds.data() + 64 * z;
    if (std::memcmp(a, b, 64 * sizeof(LogOdds)) == 0) continue;
    for (int i = 0; i < 64; ++i) other.words[z] |= std::uint64_t{a[i] != b[i]} << i;
  }
  return other;
}

// The voxels that differ. A voxel that was never observed has log-odds 0 and is not occupied.
BlockMask Changed(const VoxelBlock& before, const VoxelBlock& after, MapDetail detail) {
  BlockMask changed;
  if (detail == MapDetail::kLogOdds) changed = OtherLogOdds(before, after);
  for (int z = 0; z < 8; ++z) {
    changed.words[z] |= before.observed.words[z] ^ after.observed.words[z];
    changed.words[z] |= before.occupied.words[z] ^ after.occupied.words[z];
  }
  return changed;
}

// What stands for an observed voxel in a delta.
LogOdds ValueOf(const VoxelBlock& block, int index, const OccupancyModel& model, MapDetail detail) {
  if (detail == MapDetail::kLogOdds) return block.log_odds[index];
  return block.occupied.Test(index) ? model.clamp_max : model.clamp_min;
}

}  // namespace

bool DiffMaps(const VoxelMap& from, const VoxelMap& to, MapDetail detail,
              const std::function<bool(BlockDelta)>& take) {
  const auto add = [&](BlockKey key, const VoxelBlock* before, const VoxelBlock* after) {
    if (before == nullptr) before = &kEmptyBlock;
    if (after == nullptr) after = &kEmptyBlock;
    const BlockMask changed = Changed(*before, *after, detail);
    if (!changed.Any()) return false;
    BlockDelta block{key, changed, changed, {}};
    for (int z = 0; z < 8; ++z) block.observed.words[z] &= after->observed.words[z];
    block.log_odds.reserve(block.observed.Count());
    block.observed.ForEach(
        [&](int index) { block.log_odds.push_back(ValueOf(*after, index, to.model(), detail)); });
    return !take(std::move(block));
  };
  return !BlockTree::AnyDifference(from.blocks(), to.blocks(), add);
}

MapDelta DiffMaps(const VoxelMap& from, const VoxelMap& to, MapDetail detail) {
  MapDelta delta;
  DiffMaps(from, to, detail, [&](BlockDelta block) {
    delta.push_back(std::move(block));
    return true;
  });
  return delta;
}

absl::Status ApplyMap(const std::string& field, const MapDelta& delta, VoxelMap& map) {
  for (std::size_t i = 0; i < delta.size(); ++i) {
    const BlockDelta& change = delta[i];
    BlockMask outside = change.observed;
    outside.Subtract(change.changed);
    if (!InRange(VoxelAt(change.key, 0))) {
      return absl::InvalidArgumentError(
          absl::StrCat(field, ".blocks[", i, "]: address out of range"));
    }
    if (outside.Any() ||
        change.log_odds.size() != static_cast<std::size_t>(change.observed.Count())) {
      return absl::InvalidArgumentError(
          absl::StrCat(field, ".blocks[", i, "]: masks and values disagree"));
    }
    const VoxelBlock* before = map.blocks().Find(change.key);
    VoxelBlock block = before == nullptr ? kEmptyBlock : *before;
    auto value = change.log_odds.begin();
    change.changed.ForEach([&](int index) {
      change.observed.Test(index) ? block.Set(index, *value++, map.model()) : block.Forget(index);
    });
    map.PutBlock(change.key, block);
  }
  return absl::OkStatus();
}

}  // namespace clearway
