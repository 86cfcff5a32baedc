#include "map/marked_cones.h"

#include <algorithm>
#include <cmath>

#include "base/multiversion.h"

namespace clearway {
namespace {

// Rays are taken to stray this far from their lines near the origin; what rounding adds with the
// distance is far below the widening of the slopes.
constexpr double kStrayVoxels = 1e-2;

std::int32_t RoundDown(double value) {
  const auto toward_zero = static_cast<std::int32_t>(value);
  return toward_zero - static_cast<std::int32_t>(value < toward_zero);
}

// In a square of `across` by `across` cells, row by row, those of eight directions.
CLEARWAY_MULTIVERSION void CellsOf(const LaneFloats& main, const LaneFloats& b, const LaneFloats& c,
                                   int across, LaneInts& cell) {
  const int half = across / 2;
  const LaneFloats most = LaneFloats{} + static_cast<float>(half - 1);
  const LaneFloats scale = static_cast<float>(half) / (main < 0 ? -main : main);
  const auto place = [&](const LaneFloats& other, LaneInts& along) {
    // Whatever rounds: no cone has directions of both signs.
    const LaneFloats cells = scale * other;  // perhaps not a number
    const LaneFloats outward = cells < 0 ? -cells : cells;
    const LaneInts steps = __builtin_convertvector(outward < most ? outward : most, LaneInts);
    along = other < 0 ? half - 1 - steps : half + steps;
  };
  LaneInts row;
  place(b, cell);
  place(c, row);
  cell += across * row;
}

}  // namespace

// A cone's least and greatest slopes along an axis, widened by what FindDepths rounds.
struct MarkedCones::Slopes {
  Slopes(int cell, int across)
      : least(2 * (cell - kRounding) / across - 1),
        most(2 * (cell + 1 + kRounding) / across - 1),
        negative(cell < across / 2) {}

  static constexpr double kRounding = 1e-3;
  double least, most;
  bool negative;
};

MarkedCones::MarkedCones(const VoxelGrid& grid, const Eigen::Vector3d& origin, int main_axis,
                         bool negative, int across)
    : resolution_m_(grid.resolution_m()),
      axis_(main_axis),
      b_((main_axis + 1) % 3),
      c_((main_axis + 2) % 3),
      sign_(negative ? -1 : 1) {
  const VoxelKey voxel = grid.KeyOf(origin);
  origin_voxel_ = {voxel.x, voxel.y, voxel.z};
  for (int i = 0; i < 3; ++i) origin_[i] = origin[i] / resolution_m_;
  const double passed = origin_[axis_] - origin_voxel_[axis_];
  first_layer_ = std::clamp(negative ? passed : 1 - passed, 0.0, 1.0);
  for (int level = 0; level < kLevels; ++level) levels_.emplace_back(across >> level);
}

void MarkedCones::FindDepths(const LaneFloats (&direction)[3], const BitWindow& window,
                             LaneDoubles& depths_m) {
  Level& narrow = levels_[0];
  LaneInts cell;
  CellsOf(direction[axis_], direction[b_], direction[c_], narrow.across, cell);
  for (int lane = 0; lane < kLanes; ++lane) {
    const Cone& cone = narrow.cones[cell[lane]];
    const int layers = cone.looked_in == round_ ? cone.layers
                                                : Layers(0, cell[lane] % narrow.across,
                                                         cell[lane] / narrow.across, window);
    depths_m[lane] = (LayerBegin(layers) - kStrayVoxels) * resolution_m_;
  }
}

int MarkedCones::Layers(int level, int b, int c, const BitWindow& window) {
  const int across = levels_[level].across;
  Cone& cone = levels_[level].cones[b + across * c];
  if (cone.looked_in == round_) return cone.layers;
  cone.looked_in = round_;
  if (level + 1 < kLevels) {
    cone.layers = std::max(cone.layers, Layers(level + 1, b / 2, c / 2, window));
  }
  const Slopes slopes_b(b, across), slopes_c(c, across);
  while (LayerMarked(cone.layers, slopes_b, slopes_c, window)) ++cone.layers;
  return cone.layers;
}

bool MarkedCones::LayerMarked(int layer, const Slopes& b, const Slopes& c,
                              const BitWindow& window) const {
  const double near = LayerBegin(layer), far = LayerBegin(layer + 1);
  std::array<std::int32_t, 3> min, max;
  min[axis_] = max[axis_] = origin_voxel_[axis_] + sign_ * layer;
  const auto spread = [&](int axis, const Slopes& slopes) {
    const double least = slopes.least * (slopes.least < 0 ? far : near);
    const double most = slopes.most * (slopes.most < 0 ? near : far);
    min[axis] = RoundDown(origin_[axis] + least - kStrayVoxels);
    max[axis] = RoundDown(origin_[axis] + most + kStrayVoxels);
    // All steps along the axis have one sign: none leads behind the origin's voxel.
    auto& behind = slopes.negative ? max[axis] : min[axis];
    behind = slopes.negative ? std::min(behind, origin_voxel_[axis])
                             : std::max(behind, origin_voxel_[axis]);
  };
  spread(b_, b);
  spread(c_, c);
  return window.AllSet({min[0], min[1], min[2]}, {max[0], max[1], max[2]});
}

}  // namespace clearway
