#include "scene/surface_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

// The columns of L, where L L^T is the matrix: symmetric, and not negative but for rounding.
std::array<Eigen::Vector3d, 3> Factors(const Eigen::Matrix3d& m) {
  const auto root = [](double value) { return std::sqrt(std::max(value, 1e-12)); };
  const double l00 = root(m(0, 0)), l10 = m(1, 0) / l00, l20 = m(2, 0) / l00;
  const double l11 = root(m(1, 1) - l10 * l10), l21 = (m(2, 1) - l20 * l10) / l11;
  const double l22 = root(m(2, 2) - l20 * l20 - l21 * l21);
  return {{{l00, l10, l20}, {0, l11, l21}, {0, 0, l22}}};
}

}  // namespace

SurfaceCells::SurfaceCells(BlockMoments& moments, Size size, const Eigen::Vector3d& origin)
    : moments_(&moments),
      shift_(size == Size::kBlock ? 0 : 1),
      voxel_m_(moments.grid().resolution_m()),
      per_m_(moments.grid().voxels_per_m() / (kBlockSize >> shift_)),
      origin_(origin) {}

const SurfaceCells::Cell* SurfaceCells::At(const Eigen::Vector3d& p_M) {
  constexpr double kFar = 1e9;  // cells; nothing is there
  const auto index = [&](double x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x * per_m_), -kFar, kFar));
  };
  const Eigen::Vector3d p = p_M + origin_;
  const auto [entry, fresh] = seen_.try_emplace({index(p.x()), index(p.y()), index(p.z())});
  if (fresh) entry->second = CellAround(entry->first);
  return entry->second ? &*entry->second : nullptr;
}

std::optional<SurfaceCells::Cell> SurfaceCells::CellAround(BlockKey key) {
  constexpr double kFewest = 3;  // voxels that make a distribution
  Moments around;
  BlockKey block;  // most often that of the cell before, too
  const BlockMoments::OfBlock* of_block = nullptr;
  for (int i = 0; i < 27; ++i) {
    const BlockKey at{key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1};
    const BlockKey of_cell{at.x >> shift_, at.y >> shift_, at.z >> shift_};
    if (i == 0 || of_cell != block) of_block = moments_->Find(of_cell);
    block = of_cell;
    if (of_block == nullptr) continue;
    const int octant = (at.x & 1) | (at.y & 1) << 1 | (at.z & 1) << 2;
    const Moments& cell = shift_ == 0 ? of_block->whole : of_block->octants[octant];
    if (cell.count > 0) around.Add(cell);
  }
  if (around.count < kFewest) return std::nullopt;
  return CellOf(around);
}

// The information of the distribution, less that of a wider one: for a thin surface that is nearly
// all across it, and nearly none along it. Where a voxel lies, nobody knows better than by half of
// its edge.
SurfaceCells::Cell SurfaceCells::CellOf(const Moments& around) const {
  constexpr double kOwnVariance = 0.25, kWider = 2;  // in squares of voxels
  const Eigen::Vector3d mean = around.first / around.weight;
  Cell cell;
  cell.mean_M = mean - origin_;
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      covariance(i, j) = around.second(i, j) / around.weight - mean[i] * mean[j];
    }
    covariance(i, i) += kOwnVariance * voxel_m_ * voxel_m_;
  }
  Eigen::Matrix3d wider = covariance;
  for (int i = 0; i < 3; ++i) wider(i, i) += kWider * voxel_m_ * voxel_m_;
  cell.factors = Factors(covariance.inverse() - wider.inverse());
  return cell;
}

}  // namespace clearway
