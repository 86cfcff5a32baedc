// A sparse three-way occupancy map.
#pragma once

#include <cstdint>
#include <optional>

#include "clearway/map/block_tree.h"
#include "clearway/map/occupancy_model.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// An occupancy map in one frame: unknown, free or occupied for each voxel, with its log-odds. A
// value with O(1) copies that share memory (see BlockTree for what may run on which thread).
class VoxelMap {
 public:
  // resolution_m > 0.
  explicit VoxelMap(double resolution_m, const OccupancyModel& model = {})
      : grid_(resolution_m), model_(model) {}

  const VoxelGrid& grid() const { return grid_; }
  const OccupancyModel& model() const { return model_; }
  const BlockTree& blocks() const { return blocks_; }

  // Keys outside the addressable range are unknown.
  VoxelState State(VoxelKey key) const;
  // Log-odds of an observed voxel, as stored.
  std::optional<LogOdds> Find(VoxelKey key) const;

  std::int64_t observed_count() const { return observed_count_; }
  std::int64_t occupied_count() const { return occupied_count_; }

  // Applies a scan: one hit or one miss per marked voxel, a hit beats a miss, an end voxel without
  // a hit stays as it is. A block in which nothing changes (every miss already at the clamp) is not
  // copied. The result does not depend on the number of threads.
  void Update(const ScanUpdate& update, ThreadPool& pool);

  // Stores one voxel. The value is clamped to the model's range. The key must be InRange.
  void Set(VoxelKey key, LogOdds value);
  // Makes every voxel whose centre lies in the box (VoxelGrid::CentersIn) unknown again. Returns
  // how many of them were not before.
  std::int64_t Forget(const Aabb& box);
  // Makes all voxels of the blocks that do not meet the box unknown again.
  void ForgetBlocksOutside(const Aabb& box);
  // Replaces a whole block, counts kept right. `block` must be canonical for this map's model.
  void PutBlock(BlockKey key, const VoxelBlock& block);

  // The smallest box around all observed (occupied) voxels; empty if there are none.
  Aabb ObservedBox() const;
  Aabb OccupiedBox() const;

 private:
  VoxelGrid grid_;
  OccupancyModel model_;
  BlockTree blocks_;
  std::int64_t observed_count_ = 0;
  std::int64_t occupied_count_ = 0;
};

// Same grid, model and voxels.
bool operator==(const VoxelMap& a, const VoxelMap& b);

}  // namespace clearway
