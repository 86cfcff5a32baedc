#include "scene/voxel_hull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <vector>

namespace clearway {
namespace {

// A row of voxels along x, from the first to the last that is occupied.
struct Row {
  std::int32_t y, z, first_x, last_x;
};

// By z and y, each once.
std::vector<Row> OccupiedRows(const VoxelMap& map) {
  std::vector<Row> rows;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    const auto [x, y, z] = VoxelAt(key, 0);
    for (int line = 0; line < kBlockSize * kBlockSize; ++line) {
      const int in_y = line % kBlockSize, in_z = line / kBlockSize;
      const auto bits = static_cast<std::uint8_t>(block.occupied.words[in_z] >> kBlockSize * in_y);
      if (bits == 0) continue;
      rows.push_back({y + in_y, z + in_z, x + std::countr_zero(bits),
                      x + kBlockSize - 1 - std::countl_zero(bits)});
    }
  });
  std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.z, row.y); });
  std::size_t size = 0;
  for (const Row& row : rows) {
    if (size == 0 || rows[size - 1].y != row.y || rows[size - 1].z != row.z) {
      rows[size++] = row;
      continue;
    }
    Row& same = rows[size - 1];
    same.first_x = std::min(same.first_x, row.first_x);
    same.last_x = std::max(same.last_x, row.last_x);
  }
  rows.resize(size);
  return rows;
}

struct Corner {
  std::int64_t y, x;
};

// Puts a corner at the end of a chain that bends to one side only: at the least x (sign 1) or the
// greatest (-1) of each y, by ascending y.
void Extend(std::vector<Corner>& chain, Corner next, std::int64_t sign) {
  if (!chain.empty() && chain.back().y == next.y) {
    if (sign * next.x >= sign * chain.back().x) return;
    chain.pop_back();
  }
  while (chain.size() >= 2) {
    const Corner& a = chain[chain.size() - 2];
    const Corner& b = chain.back();
    const std::int64_t bend = (b.y - a.y) * (next.x - a.x) - (b.x - a.x) * (next.y - a.y);
    if (sign * bend > 0) break;
    chain.pop_back();
  }
  chain.push_back(next);
}

}  // namespace

std::vector<Eigen::Vector3d> HullCandidates(const VoxelMap& map) {
  std::vector<std::array<std::int64_t, 3>> corners;
  const std::vector<Row> rows = OccupiedRows(map);
  std::vector<Corner> least, greatest;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    for (const std::int64_t y : {row.y, row.y + 1}) {
      Extend(least, {y, row.first_x}, 1);
      Extend(greatest, {y, row.last_x + 1}, -1);
    }
    if (i + 1 < rows.size() && rows[i + 1].z == row.z) continue;
    for (std::vector<Corner>* chain : {&least, &greatest}) {
      for (const auto& [y, x] : *chain) {
        for (const std::int64_t z : {row.z, row.z + 1}) corners.push_back({x, y, z});
      }
      chain->clear();
    }
  }
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Eigen::Vector3d> points;
  points.reserve(corners.size());
  for (const auto& [x, y, z] : corners) points.emplace_back(x, y, z);
  return points;
}

}  // namespace clearway
