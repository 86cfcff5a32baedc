#include "scene/block_moments.h"

#include <algorithm>

namespace clearway {
namespace {

// Of the voxels of an octant, in whole numbers: voxels from the block's corner.
struct VoxelSums {
  std::int32_t count = 0, weight = 0;
  std::array<std::int32_t, 3> first{};
  std::array<std::int32_t, 6> second{};  // xx, xy, xz, yy, yz, zz

  void Add(std::int32_t of_weight, std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::int32_t wx = of_weight * x, wy = of_weight * y, wz = of_weight * z;
    count += 1;
    weight += of_weight;
    first[0] += wx;
    first[1] += wy;
    first[2] += wz;
    second[0] += wx * x;
    second[1] += wx * y;
    second[2] += wx * z;
    second[3] += wy * y;
    second[4] += wy * z;
    second[5] += wz * z;
  }
};

// Moved from the block's first voxel to where that lies in the map.
Moments MomentsOf(const VoxelSums& sums, const Eigen::Vector3d& at, double voxel_m) {
  Moments moments;
  moments.count = sums.count;
  moments.weight = sums.weight;
  const std::array<double, 3> from_corner = {voxel_m * sums.first[0], voxel_m * sums.first[1],
                                             voxel_m * sums.first[2]};
  int next = 0;
  for (int i = 0; i < 3; ++i) {
    moments.first[i] = sums.weight * at[i] + from_corner[i];
    for (int j = i; j < 3; ++j) {
      moments.second(i, j) = moments.second(j, i) =
          voxel_m * voxel_m * sums.second[next++] + at[i] * from_corner[j] +
          at[j] * from_corner[i] + sums.weight * at[i] * at[j];
    }
  }
  return moments;
}

}  // namespace

void Moments::Add(const Moments& other) {
  count += other.count;
  weight += other.weight;
  first += other.first;
  second += other.second;
}

const BlockMoments::OfBlock* BlockMoments::Find(BlockKey block) {
  Recent& recent = recent_[(block.x & 3) | (block.y & 3) << 2 | (block.z & 3) << 4];
  if (!recent.asked || recent.block != block) recent = {block, FindOrAdd(block), true};
  return recent.sums;
}

const BlockMoments::OfBlock* BlockMoments::FindOrAdd(BlockKey key) {
  const auto [entry, fresh] = found_.try_emplace(key, nullptr);
  if (!fresh) return entry->second;
  const VoxelBlock* block = map_->blocks().Find(key);
  if (block == nullptr || !block->occupied.Any()) return nullptr;
  std::array<VoxelSums, 8> octants;
  block->occupied.ForEach([&](int index) {
    const int x = index & 7, y = index >> 3 & 7, z = index >> 6;
    // Occupied may be what is as likely free.
    const std::int32_t weight = std::max<std::int32_t>(block->log_odds[index], 1);
    octants[x >> 2 | y >> 2 << 1 | z >> 2 << 2].Add(weight, x, y, z);
  });
  OfBlock& sums = sums_.emplace_back();
  const Eigen::Vector3d at = grid().CenterOf(VoxelAt(key, 0));
  for (std::size_t i = 0; i < octants.size(); ++i) {
    if (octants[i].count == 0) continue;
    sums.octants[i] = MomentsOf(octants[i], at, grid().resolution_m());
    sums.whole.Add(sums.octants[i]);
  }
  entry->second = &sums;
  return &sums;
}

}  // namespace clearway
