#include "map/passed_voxels.h"

#include "absl/container/flat_hash_map.h"
#include "clearway/map/ray.h"
#include "map/mark_rays.h"

namespace clearway {
namespace {

bool Holds(BlockKey first, BlockKey last, BlockKey key) {
  return first.x <= key.x && key.x <= last.x && first.y <= key.y && key.y <= last.y &&
         first.z <= key.z && key.z <= last.z;
}

}  // namespace

void PassedVoxels::Clear() {
  for (Sector& sector : sectors_) sector.Clear();
}

std::vector<BlockMask> PassedVoxels::Among(std::span<const BitWindow::Block> candidates,
                                           const VoxelGrid& grid, ThreadPool& pool) {
  pool.ParallelChunks(sectors_.size(), 1,
                      [&](int, std::size_t s, std::size_t) { sectors_[s].Find(candidates, grid); });
  std::vector<BlockMask> passed(candidates.size());
  for (const Sector& sector : sectors_) {
    for (const auto& [candidate, mask] : sector.passed) passed[candidate] |= mask;
  }
  return passed;
}

void PassedVoxels::Sector::Clear() {
  for (RayEights& of_length : rays) of_length.Clear();
}

void PassedVoxels::Sector::Find(std::span<const BitWindow::Block> candidates,
                                const VoxelGrid& grid) {
  passed.clear();
  RayBoxes boxes;
  for (RayEights& of_length : rays) {
    of_length.Finish();
    boxes.Extend(BoxesAround(of_length.eights()));
  }
  if (boxes.ends.isEmpty()) return;
  const auto [first, last] = BlocksAround(grid, boxes);
  if (BitWindow::Fits(first, last)) {
    FindIn(first, last, candidates, grid);
  } else {
    FindSparsely(candidates, grid);
  }
}

void PassedVoxels::Sector::FindIn(BlockKey first, BlockKey last,
                                  std::span<const BitWindow::Block> candidates,
                                  const VoxelGrid& grid) {
  window.Cover(first, last);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!Holds(first, last, candidates[i].key)) continue;
    window.Clear(candidates[i]);
    passed.push_back({i, {}});
  }
  for (const RayEights& of_length : rays) MarkShortRays(grid, of_length.eights(), window);
  for (auto& [candidate, found] : passed) found = window.SetOf(candidates[candidate]);
}

// Without a window, which would be too large.
void PassedVoxels::Sector::FindSparsely(std::span<const BitWindow::Block> candidates,
                                        const VoxelGrid& grid) {
  absl::flat_hash_map<BlockKey, std::size_t> by_key;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    by_key.emplace(candidates[i].key, i);
    passed.push_back({i, {}});
  }
  const auto look_at = [&](VoxelKey voxel) {
    const auto entry = by_key.find(BlockOf(voxel));
    if (entry == by_key.end()) return;
    const int at = IndexInBlock(voxel);
    if (candidates[entry->second].mask.Test(at)) passed[entry->second].mask.Set(at);
  };
  for (const RayEights& of_length : rays) {
    of_length.ForEach([&](const RaySegment& ray) { WalkRay(grid, ray.origin, ray.end, look_at); });
  }
}

}  // namespace clearway
