#include "report/column_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace clearway::report {
namespace {

constexpr double kCellM = 2.0;          // of the grid that the ground is estimated on
constexpr double kMaxSlope = 0.15;      // steeper than most roads
constexpr double kQuantile = 0.2;       // of the lowest voxels of a cell: below lie stray ones
constexpr std::size_t kMinColumns = 5;  // fewer say nothing of the ground
constexpr double kBelowGroundM = 0.5;   // voxels this far below still belong to it
constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();

// Calls visit(cell, z, occupied) for every observed voxel of the area.
template <class Visit>
void ForEachVoxel(const VoxelMap& map, const ColumnMap& area, Visit&& visit) {
  const BlockKey low = BlockOf({area.x0, area.y0, -kMaxVoxelIndex});
  const BlockKey high =
      BlockOf({area.x0 + area.width - 1, area.y0 + area.height - 1, kMaxVoxelIndex - 1});
  map.blocks().ForEachIn(low, high, [&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach([&](int index) {
      const VoxelKey voxel = VoxelAt(key, index);
      const int x = voxel.x - area.x0, y = voxel.y - area.y0;
      if (x < 0 || y < 0 || x >= area.width || y >= area.height) return;
      visit(x + static_cast<std::size_t>(area.width) * y, voxel.z, block.occupied.Test(index));
    });
  });
}

// The height of the ground over a coarse grid, in voxels.
class Ground {
 public:
  Ground(const ColumnMap& area, const std::vector<std::int32_t>& lowest)
      : step_(std::max(1, static_cast<int>(std::lround(kCellM / area.resolution_m)))),
        width_((area.width + step_ - 1) / step_),
        height_((area.height + step_ - 1) / step_),
        z_(static_cast<std::size_t>(width_) * height_, std::numeric_limits<double>::infinity()) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) At(x, y) = QuantileOfCell(area, lowest, x, y);
    }
    LimitSlope();
  }

  // Infinity if nothing is known anywhere.
  double ZAt(int column_x, int column_y) const {
    const double x = std::clamp((column_x + 0.5) / step_ - 0.5, 0.0, width_ - 1.0);
    const double y = std::clamp((column_y + 0.5) / step_ - 0.5, 0.0, height_ - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, width_ - 1), y1 = std::min(y0 + 1, height_ - 1);
    const double u = x - x0, v = y - y0;
    if (std::isinf(At(x0, y0))) return At(x0, y0);
    return (1 - v) * ((1 - u) * At(x0, y0) + u * At(x1, y0)) +
           v * ((1 - u) * At(x0, y1) + u * At(x1, y1));
  }

 private:
  double& At(int x, int y) { return z_[x + static_cast<std::size_t>(width_) * y]; }
  double At(int x, int y) const { return z_[x + static_cast<std::size_t>(width_) * y]; }

  double QuantileOfCell(const ColumnMap& area, const std::vector<std::int32_t>& lowest, int x,
                        int y) const {
    std::vector<std::int32_t> values;
    for (int j = y * step_; j < std::min((y + 1) * step_, area.height); ++j) {
      for (int i = x * step_; i < std::min((x + 1) * step_, area.width); ++i) {
        const std::int32_t z = lowest[i + static_cast<std::size_t>(area.width) * j];
        if (z != kNone) values.push_back(z);
      }
    }
    if (values.size() < kMinColumns) return std::numeric_limits<double>::infinity();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(kQuantile * values.size());
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  // The lower envelope of cones of the greatest slope over all cells (Borgefors' two sweeps); it
  // also fills the cells without a value.
  void LimitSlope() {
    const double straight = kMaxSlope * step_, diagonal = straight * std::sqrt(2.0);
    const auto pull = [&](int x, int y, int dx, int dy) {
      if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) return;
      const double step = dx != 0 && dy != 0 ? diagonal : straight;
      At(x, y) = std::min(At(x, y), At(x + dx, y + dy) + step);
    };
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        for (int dx = -1; dx <= 1; ++dx) pull(x, y, dx, -1);
        pull(x, y, -1, 0);
      }
    }
    for (int y = height_ - 1; y >= 0; --y) {
      for (int x = width_ - 1; x >= 0; --x) {
        for (int dx = -1; dx <= 1; ++dx) pull(x, y, dx, 1);
        pull(x, y, 1, 0);
      }
    }
  }

  int step_;  // columns along an edge of a cell
  int width_, height_;
  std::vector<double> z_;
};

ColumnMap EmptyColumns(const VoxelGrid& grid, const Aabb& area) {
  ColumnMap result;
  result.resolution_m = grid.resolution_m();
  const VoxelKey low = grid.KeyOf(area.min), high = grid.KeyOf(area.max);
  result.x0 = low.x;
  result.y0 = low.y;
  result.width = high.x - low.x + 1;
  result.height = high.y - low.y + 1;
  result.columns.resize(static_cast<std::size_t>(result.width) * result.height);
  return result;
}

}  // namespace

ColumnMap ColumnsOf(const VoxelMap& map, const Aabb& area, double max_height_m) {
  ColumnMap result = EmptyColumns(map.grid(), area);
  std::vector<std::int32_t> lowest(result.columns.size(), kNone);
  std::vector<std::int32_t> lowest_observed(result.columns.size(), kNone);
  ForEachVoxel(map, result, [&](std::size_t cell, std::int32_t z, bool occupied) {
    lowest_observed[cell] = std::min(lowest_observed[cell], z);
    if (occupied) lowest[cell] = std::min(lowest[cell], z);
  });
  Ground ground(result, lowest);
  if (std::isinf(ground.ZAt(0, 0))) ground = Ground(result, lowest_observed);

  ForEachVoxel(map, result, [&](std::size_t cell, std::int32_t z, bool occupied) {
    const int x = static_cast<int>(cell % result.width), y = static_cast<int>(cell / result.width);
    const double height_m = (z - ground.ZAt(x, y)) * result.resolution_m;
    if (height_m > max_height_m || height_m < -kBelowGroundM) return;
    Column& column = result.columns[cell];
    if (!occupied) {
      if (column.state == VoxelState::kUnknown) column.state = VoxelState::kFree;
    } else if (column.state != VoxelState::kOccupied || height_m > column.height_m) {
      column = {VoxelState::kOccupied, static_cast<float>(height_m)};
    }
  });
  return result;
}

}  // namespace clearway::report
