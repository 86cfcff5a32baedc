#include "scene/surface_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

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

void SurfaceCells::Sums::Add(double of_weight, const Eigen::Vector3d& p) {
  count += 1;
  weight += of_weight;
  for (int i = 0; i < 3; ++i) {
    first[i] += of_weight * p[i];
    for (int j = 0; j < 3; ++j) second(i, j) += of_weight * p[i] * p[j];
  }
}

void SurfaceCells::Sums::Add(const Sums& other) {
  count += other.count;
  weight += other.weight;
  first += other.first;
  second += other.second;
}

SurfaceCells::SurfaceCells(const VoxelMap& map_O, int bits)
    : voxel_m_(map_O.grid().resolution_m()), per_m_(map_O.grid().voxels_per_m() / (1 << bits)) {
  const int shift = kBlockBits - bits;  // to the cells of a block
  std::vector<Sums> of_block(std::size_t{1} << 3 * shift);
  map_O.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    std::ranges::fill(of_block, Sums{});
    block.occupied.ForEach([&](int index) {
      const int x = index & 7, y = index >> 3 & 7, z = index >> 6;
      const int cell = x >> bits | y >> bits << shift | z >> bits << 2 * shift;
      of_block[cell].Add(block.log_odds[index], map_O.grid().CenterOf(VoxelAt(key, index)));
    });
    const int across = (1 << shift) - 1;
    for (int cell = 0; cell < static_cast<int>(of_block.size()); ++cell) {
      if (of_block[cell].count == 0) continue;
      const BlockKey at{(key.x << shift) + (cell & across),
                        (key.y << shift) + (cell >> shift & across),
                        (key.z << shift) + (cell >> 2 * shift)};
      sums_.emplace(at, of_block[cell]);
    }
  });
}

const SurfaceCells::Cell* SurfaceCells::At(const Eigen::Vector3d& p_O) {
  constexpr double kFar = 1e9;  // cells; nothing is there
  const auto index = [&](double x) {
    return static_cast<std::int32_t>(std::clamp(std::floor(x * per_m_), -kFar, kFar));
  };
  const auto [entry, fresh] = seen_.try_emplace({index(p_O.x()), index(p_O.y()), index(p_O.z())});
  if (fresh) entry->second = CellAround(entry->first);
  return entry->second ? &*entry->second : nullptr;
}

std::optional<SurfaceCells::Cell> SurfaceCells::CellAround(BlockKey key) const {
  constexpr double kFewest = 3;  // voxels that make a distribution
  Sums around;
  for (int i = 0; i < 27; ++i) {
    const auto entry = sums_.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (entry != sums_.end()) around.Add(entry->second);
  }
  if (around.count < kFewest) return std::nullopt;
  return CellOf(around, voxel_m_);
}

// The information of the distribution, less that of a wider one: for a thin surface that is nearly
// all across it, and nearly none along it. Where a voxel lies, nobody knows better than by half of
// its edge.
SurfaceCells::Cell SurfaceCells::CellOf(const Sums& sums, double voxel_m) {
  constexpr double kOwnVariance = 0.25, kWider = 2;  // in squares of voxels
  Cell cell;
  cell.mean_O = sums.first / sums.weight;
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      covariance(i, j) = sums.second(i, j) / sums.weight - cell.mean_O[i] * cell.mean_O[j];
    }
    covariance(i, i) += kOwnVariance * voxel_m * voxel_m;
  }
  Eigen::Matrix3d wider = covariance;
  for (int i = 0; i < 3; ++i) wider(i, i) += kWider * voxel_m * voxel_m;
  cell.factors = Factors(covariance.inverse() - wider.inverse());
  return cell;
}

}  // namespace clearway
