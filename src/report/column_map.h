// A map seen from above: one cell for each column of voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "clearway/map/voxel_map.h"

namespace clearway::report {

// What is known of one column.
struct Column {
  VoxelState state = VoxelState::kUnknown;
  float height_m = 0;  // of the highest occupied voxel over the ground, if occupied
};

// The columns of an area, one cell a voxel wide. A value.
struct ColumnMap {
  std::int32_t x0 = 0, y0 = 0;  // voxel index of cell (0, 0)
  int width = 0, height = 0;
  double resolution_m = 0.1;
  std::vector<Column> columns;  // cell (x, y) is at x + width * y

  const Column& At(int x, int y) const { return columns[x + std::size_t(width) * y]; }
};

// The columns over `area` (its z does not matter). Voxels more than max_height_m above the ground
// around them are left out. The ground is taken to be the surface of limited slope under the lowest
// occupied voxels; stray voxels below it do not pull it down.
ColumnMap ColumnsOf(const VoxelMap& map, const Aabb& area, double max_height_m);

}  // namespace clearway::report
